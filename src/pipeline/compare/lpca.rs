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

/// Ways between directions: a name, and (θ, φ) in degrees of view and light at the begin and at the end.
const WAYS: [(&str, [[(f64, f64); 2]; 2]); 4] = [
    ("light falls", [[(0.0, 0.0), (0.0, 10.0)], [(0.0, 0.0), (75.0, 10.0)]]),
    ("light turns", [[(0.0, 0.0), (55.0, 0.0)], [(0.0, 0.0), (55.0, 60.0)]]),
    ("view falls", [[(0.0, 250.0), (40.0, 100.0)], [(75.0, 250.0), (40.0, 100.0)]]),
    ("both turn", [[(52.0, 180.0), (52.0, 0.0)], [(52.0, 240.0), (52.0, 60.0)]]),
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
    if !errors.is_empty() {
        let caption = format!(
            "What {} clusters of {} eigenvectors leave after each assignment of texels, √(Σ (R − L)² / Σ L²), with the samples weighted as they \
             were when it was fitted. In all: {lpca}.",
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
    let direction = |(theta, phi): (f64, f64)| Direction::from_degrees(theta, phi);
    let row = |(name, [start, end]): &(&str, [[(f64, f64); 2]; 2])| {
        let cells = (0..STEPS).map(|step| {
            let part = f64::from(step) / f64::from(STEPS - 1);
            let [view, light] = [0, 1].map(|of| direction(start[of]).toward(direction(end[of]), part));
            let picture = job.studio.picture(subject, view, light, job.progress)?;
            Ok(Cell { picture, note: String::new() })
        });
        let [[view, light], [end_view, end_light]] = [start, end].map(|directions| directions.map(direction));
        let label = format!("{name}: view {view} to {end_view}, light {light} to {end_light}");
        Ok(Row { label, cells: cells.collect::<Result<_, PipelineError>>()? })
    };
    Ok(Figure {
        stem: "between",
        title: "Between measured directions",
        caption: "Views and lights in even steps, most of them not measured: interpolated between the nearest measured ones.".to_owned(),
        columns: (1..=STEPS).map(|step| step.to_string()).collect(),
        rows: WAYS.iter().map(row).collect::<Result<_, PipelineError>>()?,
    })
}
