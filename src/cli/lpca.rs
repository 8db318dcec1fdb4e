//! Options of local PCA.

use bytesize::ByteSize;
use clap::{Args, builder::PossibleValuesParser, builder::TypedValueParser};

use super::{arguments, memory};
use crate::model::{LpcaMethod, LpcaSettings, LpcaTarget, Weighting};

/// How the original is compressed.
#[derive(Debug, Clone, Copy, Args)]
#[command(next_help_heading = "Local PCA of the original")]
pub struct LpcaArguments {
    /// Clusters of texels
    #[arg(long, value_name = "K", default_value_t = LpcaSettings::default().clusters, allow_negative_numbers = true, value_parser = clap::value_parser!(u32).range(1..=256))]
    clusters: u32,
    /// Eigenvectors of a cluster
    #[arg(long, value_name = "C", default_value_t = LpcaSettings::default().components, allow_negative_numbers = true, value_parser = clap::value_parser!(u32).range(1..=32))]
    components: u32,
    /// Choose the smallest numbers of clusters and components that leave at most this relative RMS error, such as 0.05
    #[arg(long, value_name = "ERROR", conflicts_with_all = ["clusters", "components", "target_size"], allow_negative_numbers = true, value_parser = arguments::part)]
    target_error: Option<f64>,
    /// Choose the numbers of clusters and components that leave the least in at most this much of an adapter's memory, such as 8MiB
    #[arg(long, value_name = "BYTES", conflicts_with_all = ["clusters", "components"], value_parser = memory::size)]
    target_size: Option<ByteSize>,
    /// Vectors of the global basis [default: as many as leave out 1 % of the variance, at most 128]
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = clap::value_parser!(u32).range(1..=256))]
    rank: Option<u32>,
    /// Alternations of assignment and PCA at most
    #[arg(long, value_name = "N", default_value_t = LpcaSettings::default().iterations, allow_negative_numbers = true, value_parser = clap::value_parser!(u32).range(1..=1000))]
    iterations: u32,
    /// How much a sample counts: all alike, by the cosine of its view, or so that errors are nearly those of logarithms, for highlights
    #[arg(long, value_name = "HOW", default_value = "even", value_parser = weighting())]
    weighting: Weighting,
    /// Where clusters alternate: in a global basis, or directly, which takes far longer
    #[arg(long, value_name = "METHOD", default_value = "basis", value_parser = method())]
    lpca_method: LpcaMethod,
    /// Seed of the sketch and of the first clusters
    #[arg(long, value_name = "N", default_value_t = LpcaSettings::default().seed)]
    seed: u32,
    /// Leave the local PCA out
    #[arg(long)]
    no_lpca: bool,
}

impl LpcaArguments {
    /// What was typed.
    pub fn settings(self) -> Option<LpcaSettings> {
        let target = self.target_error.map(LpcaTarget::Error).or(self.target_size.map(|bytes| LpcaTarget::Size(bytes.as_u64())));
        (!self.no_lpca).then_some(LpcaSettings {
            clusters: self.clusters,
            components: self.components,
            target,
            rank: self.rank,
            iterations: self.iterations,
            weighting: self.weighting,
            method: self.lpca_method,
            seed: self.seed,
        })
    }
}

fn weighting() -> impl TypedValueParser<Value = Weighting> {
    PossibleValuesParser::new(["even", "cosine", "log"]).map(|name| match name.as_str() {
        "cosine" => Weighting::Cosine,
        "log" => Weighting::Log,
        _ => Weighting::Even,
    })
}

fn method() -> impl TypedValueParser<Value = LpcaMethod> {
    PossibleValuesParser::new(["basis", "direct"]).map(|name| if name == "direct" { LpcaMethod::Direct } else { LpcaMethod::Basis })
}
