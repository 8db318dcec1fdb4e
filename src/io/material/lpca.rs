//! A material's local PCA on disk.

use std::{ops::RangeInclusive, path::Path};

use half::f16;
use serde_json::{Value, json};

use super::{
    array::{Reader, Writer, fault},
    format::{self, Layout, Lengths},
};
use crate::{
    data::{Learned, Lpca, Pair, Provenance},
    io::{ArrayFault, IoError},
    model::{MAX_CLUSTERS, MAX_COMPONENTS},
};

/// The group's attribute "lpca".
#[derive(serde::Serialize, serde::Deserialize)]
pub(super) struct Attribute {
    samples: usize,
    clusters: usize,
    components: usize,
    learned: Learned,
}

impl Attribute {
    pub(super) fn of(lpca: &Lpca) -> Self {
        Self { samples: lpca.pairs.len(), clusters: lpca.clusters, components: lpca.components, learned: lpca.learned.clone() }
    }

    /// Reads it; null where there is no local PCA.
    pub(super) fn read(attribute: &Value) -> Result<Option<Self>, String> {
        let read: Option<Self> = serde_json::from_value(attribute.clone()).map_err(|error| format!("cannot be read: {error}"))?;
        read.map(Self::in_range).transpose()
    }

    fn in_range(self) -> Result<Self, String> {
        let numbers: [(&str, usize, RangeInclusive<usize>); 3] = [
            // What can be counted in a shader.
            ("samples", self.samples, 1..=u32::MAX as usize),
            ("clusters", self.clusters, 1..=MAX_CLUSTERS as usize),
            ("components", self.components, 1..=MAX_COMPONENTS as usize),
        ];
        match numbers.into_iter().find(|(_, number, range)| !range.contains(number)) {
            Some((name, number, range)) => Err(format!("has {number} {name}: expected {} to {}", range.start(), range.end())),
            None => Ok(self),
        }
    }

    /// Lengths of the dimensions over `plane`.
    pub(super) fn lengths(&self, plane: [usize; 2]) -> Lengths {
        Lengths { plane, samples: self.samples, clusters: self.clusters, components: self.components }
    }
}

/// Writes the arrays.
pub(super) fn store(writer: &Writer, lpca: &Lpca, provenance: &Provenance) -> Result<(), IoError> {
    let Lpca { pairs, cluster, weights, terms, error, .. } = lpca;
    // What cannot be read again is not written.
    Attribute::read(&json!(Attribute::of(lpca))).map_err(|found| super::not_written(writer.path, &format!("the local PCA {found}")))?;
    check(writer.path, lpca, provenance)?;
    #[expect(clippy::cast_possible_truncation, reason = "nobody lists four billion directions")]
    let pairs: Vec<[u32; 2]> = pairs.iter().map(|&Pair { view, light }| [view as u32, light as u32]).collect();
    #[expect(clippy::cast_possible_truncation, reason = "a cluster is below their number, which is at most 256")]
    let clusters: Vec<u8> = cluster.values().iter().map(|&cluster| cluster as u8).collect();
    writer.map(&format::LPCA_CLUSTER, cluster, &clusters)?;
    writer.values(&format::LPCA_WEIGHTS, weights)?;
    writer.values(&format::LPCA_TERMS, terms)?;
    writer.map(&format::LPCA_ERROR, error, error.values())?;
    writer.values(&format::LPCA_PAIRS, pairs.as_flattened())
}

/// Reads the arrays.
pub(super) fn load(reader: &Reader, attribute: Attribute, provenance: &Provenance) -> Result<Lpca, IoError> {
    let Attribute { clusters, components, learned, samples: _ } = attribute;
    let pairs: Vec<u32> = reader.values(&format::LPCA_PAIRS)?;
    let lpca = Lpca {
        pairs: pairs.as_chunks().0.iter().map(|&[view, light]| Pair { view: view as usize, light: light as usize }).collect(),
        clusters,
        components,
        cluster: reader.scalars::<u8>(&format::LPCA_CLUSTER)?.map(|&cluster| u32::from(cluster)),
        weights: reader.values(&format::LPCA_WEIGHTS)?,
        terms: reader.values(&format::LPCA_TERMS)?,
        error: reader.scalars(&format::LPCA_ERROR)?,
        learned,
    };
    check(reader.path, &lpca, provenance)?;
    Ok(lpca)
}

/// Checks that a renderer finds what it looks up, and numbers there.
fn check(path: &Path, lpca: &Lpca, provenance: &Provenance) -> Result<(), IoError> {
    let expect = |layout: &Layout, what, expected: String, found: Option<String>| match found {
        Some(found) => Err(fault(path, layout, ArrayFault::Unexpected { what, expected, found })),
        None => Ok(()),
    };
    let (views, lights) = (provenance.views.len(), provenance.lights.len());
    let beyond = lpca.pairs.iter().find(|pair| pair.view >= views || pair.light >= lights);
    let directions = format!("below {views} views and {lights} lights");
    expect(&format::LPCA_PAIRS, "pairs", directions, beyond.map(|pair| format!("view {}, light {}", pair.view, pair.light)))?;
    let beyond = lpca.cluster.values().iter().find(|&&cluster| cluster as usize >= lpca.clusters);
    expect(&format::LPCA_CLUSTER, "clusters", format!("below {}", lpca.clusters), beyond.map(u32::to_string))?;
    for (layout, values) in [(&format::LPCA_WEIGHTS, &lpca.weights), (&format::LPCA_TERMS, &lpca.terms)] {
        let wild = values.iter().find(|value| !value.is_finite());
        expect(layout, "values", "that are finite".to_owned(), wild.map(f16::to_string))?;
    }
    Ok(lpca.check([lpca.cluster.width(), lpca.cluster.height()])?)
}
