//! What a comparison tells of a local PCA: how it settled, what else might have been taken, and what is between the measured directions.

use serde_json::{Value, json};

use super::{pictures::Job, plot};
use crate::{
    data::{Direction, Learned, Lpca, LpcaCandidate},
    pipeline::{
        PipelineError, Subject,
        report::{Cell, Figure, Report, Row},
    },
};

/// Pictures of a way between directions.
const STEPS: u32 = 9;

/// A way between directions: (θ, φ) in degrees at the begin and at the end.
struct Way {
    name: &'static str,
    view: [(f64, f64); 2],
    light: [(f64, f64); 2],
}

const WAYS: [Way; 4] = [
    Way { name: "light falls", view: [(0.0, 0.0); 2], light: [(0.0, 10.0), (75.0, 10.0)] },
    Way { name: "light turns", view: [(0.0, 0.0); 2], light: [(55.0, 0.0), (55.0, 60.0)] },
    Way { name: "view falls", view: [(0.0, 250.0), (75.0, 250.0)], light: [(40.0, 100.0); 2] },
    Way { name: "both turn", view: [(52.0, 180.0), (52.0, 240.0)], light: [(52.0, 0.0), (52.0, 60.0)] },
];

/// All of it but the arrays.
pub fn json(lpca: &Lpca) -> Value {
    let Lpca { clusters, components, learned, .. } = lpca;
    json!({
        "clusters": clusters, "components": components, "bytes": lpca.bytes(), "source_bytes": lpca.source_bytes(), "learned": learned,
    })
}

/// How it settled, and the table of what it was chosen from.
pub fn learned(lpca: &Lpca, report: &mut Report<'_>) -> Result<(), PipelineError> {
    let Learned { errors, candidates, .. } = &lpca.learned;
    if let [first, _, ..] = errors[..] {
        let caption = format!(
            "What {} clusters of {} eigenvectors leave after each assignment of texels but the first, √(Σ (R − L)² / Σ L²), with the samples \
             weighted as they were when it was fitted. The first, to what the alternation begins with, leaves {first:.4}. In all: {lpca}.",
            lpca.clusters, lpca.components
        );
        report.drawing("iterations", "Error by iteration", &caption, &plot::iterations(errors)?)?;
    }
    if !candidates.is_empty() {
        let header = ["clusters", "components", "bytes", "estimated relative RMS"].map(String::from);
        let row = |candidate: &LpcaCandidate| {
            let LpcaCandidate { clusters, components, bytes, error } = candidate;
            vec![clusters.to_string(), components.to_string(), bytes.to_string(), format!("{error:.4}")]
        };
        let rows: Vec<_> = candidates.iter().map(row).collect();
        report.table(
            "What it was chosen from",
            "Bytes are those in an adapter's memory; errors are estimated in the basis.",
            &header,
            &rows,
        );
    }
    Ok(())
}

/// Ways between measured directions, picture by picture.
pub fn between(job: &Job<'_>, subject: &Subject) -> Result<Figure, PipelineError> {
    let row = |Way { name, view, light }: &Way| {
        let [view, light] = [view, light].map(|ends| ends.map(|(theta, phi)| Direction::from_degrees(theta, phi)));
        let cells = (0..STEPS).map(|step| {
            let [view, light] = [view, light].map(|[start, end]| start.toward(end, f64::from(step) / f64::from(STEPS - 1)));
            let picture = job.studio.picture(subject, view, light, job.progress)?;
            Ok(Cell { picture, note: String::new() })
        });
        let named = |[start, end]: [Direction; 2]| if start == end { start.to_string() } else { format!("{start} to {end}") };
        let label = format!("{name}: view {}, light {}", named(view), named(light));
        Ok(Row { label, cells: cells.collect::<Result<_, PipelineError>>()? })
    };
    Ok(Figure {
        stem: "between".to_owned(),
        title: "Between measured directions".to_owned(),
        caption: "Views and lights in even steps, most of them not measured: interpolated between the nearest measured ones.".to_owned(),
        columns: (1..=STEPS).map(|step| step.to_string()).collect(),
        rows: WAYS.iter().map(row).collect::<Result<_, PipelineError>>()?,
    })
}
