//! Stand-ins, with the signatures of what is written elsewhere.
#![expect(clippy::cast_possible_truncation, reason = "small numbers")]

/// Readers and writers.
pub mod io {
    use std::{
        fmt::Debug,
        path::{Path, PathBuf},
    };

    use crate::data::{Btf, Direction, Pair, Transfer};

    /// A reader's or writer's error.
    #[derive(Debug, thiserror::Error)]
    #[error("{path}: {reason}")]
    pub struct IoError {
        path: PathBuf,
        reason: String,
    }

    fn error(path: &Path, reason: impl std::fmt::Display) -> IoError {
        IoError { path: path.to_owned(), reason: reason.to_string() }
    }

    /// Where samples come from.
    pub trait Source: Send + Sync + Debug {
        /// What it holds.
        fn btf(&self) -> &Btf;
        /// Texels of a sample.
        ///
        /// # Errors
        /// [`IoError`].
        fn decode(&self, sample: usize) -> Result<Vec<[u8; 4]>, IoError>;
    }

    #[derive(Debug)]
    struct Gray(Btf);

    impl Source for Gray {
        fn btf(&self) -> &Btf {
            &self.0
        }
        fn decode(&self, sample: usize) -> Result<Vec<[u8; 4]>, IoError> {
            let shade = (200.0 * self.0.directions(sample).1.theta.cos()) as u8;
            Ok((0..self.0.texels()).map(|texel| [shade, (texel % 251) as u8, shade, 255]).collect())
        }
    }

    /// Opens a source.
    ///
    /// # Errors
    /// [`IoError`].
    pub fn open(path: &Path) -> Result<Box<dyn Source>, IoError> {
        std::fs::metadata(path).map_err(|reason| error(path, reason))?;
        open_zip_bytes("stand-in", &[])
    }

    /// Opens a zip in memory.
    ///
    /// # Errors
    /// [`IoError`].
    pub fn open_zip_bytes(name: &str, _bytes: &'static [u8]) -> Result<Box<dyn Source>, IoError> {
        let rings = [(0.0, 1), (17.0, 8), (32.0, 12), (50.0, 14), (65.0, 16)];
        let directions: Vec<_> = rings
            .iter()
            .flat_map(|&(theta, count)| (0..count).map(move |k| Direction::from_degrees(theta, 360.0 * f64::from(k) / f64::from(count))))
            .collect();
        let pairs = (0..51 * 51).map(|index| Pair { view: index / 51, light: index % 51 }).collect();
        let btf = Btf::new(name.to_owned(), [64, 64], directions.clone(), directions, pairs, Transfer::Srgb)
            .map_err(|reason| error(Path::new(name), reason))?;
        Ok(Box::new(Gray(btf)))
    }

    /// What a path holds.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub enum Kind {
        /// A material.
        Material,
        /// A source.
        Source,
        /// Neither.
        Neither,
    }

    /// Tells what `path` holds.
    #[must_use]
    pub fn kind(path: &Path) -> Kind {
        if path.join("zarr.json").is_file() {
            Kind::Material
        } else if path.extension().is_some_and(|extension| extension == "zip") {
            Kind::Source
        } else {
            Kind::Neither
        }
    }

    /// Materials on disk.
    pub mod material {
        use super::{IoError, Path, error};
        use crate::data::Material;

        /// Writes.
        ///
        /// # Errors
        /// [`IoError`].
        pub fn save(path: &Path, _material: &Material) -> Result<(), IoError> {
            std::fs::create_dir_all(path).and_then(|()| std::fs::write(path.join("zarr.json"), "{}")).map_err(|reason| error(path, reason))
        }

        /// Reads.
        ///
        /// # Errors
        /// [`IoError`].
        pub fn load(path: &Path) -> Result<Material, IoError> {
            std::fs::metadata(path).map_err(|reason| error(path, reason))?;
            Ok(super::super::flat())
        }
    }

    /// Pictures on disk.
    pub mod picture {
        use super::{IoError, Path, error};
        use crate::data::Map;

        /// Writes.
        ///
        /// # Errors
        /// [`IoError`].
        pub fn write(path: &Path, picture: &Map<[f32; 4]>) -> Result<(), IoError> {
            let bytes: Vec<u8> = picture.values().iter().flatten().map(|value| (value * 255.0) as u8).collect();
            match path.extension().is_some_and(|extension| extension == "png") {
                true => image::save_buffer(path, &bytes, picture.width() as u32, picture.height() as u32, image::ColorType::Rgba8)
                    .map_err(|reason| error(path, reason)),
                false => std::fs::write(path, bytes).map_err(|reason| error(path, reason)),
            }
        }
    }
}

/// Paints.
pub mod paint {
    /// sRGB to linear.
    #[must_use]
    pub fn linear_from_srgb(srgb: f64) -> f64 {
        if srgb <= 0.040_45 { srgb / 12.92 } else { ((srgb + 0.055) / 1.055).powf(2.4) }
    }

    /// A paint.
    #[derive(Debug, Clone)]
    pub struct Paint {
        /// Its name.
        pub name: String,
    }

    impl From<&pigments::Pigment> for Paint {
        fn from(pigment: &pigments::Pigment) -> Self {
            Self { name: pigment.name.to_owned() }
        }
    }

    /// A layer.
    #[derive(Debug, Clone)]
    pub struct Layer {
        /// The paint.
        pub paint: Paint,
        /// Optical thickness.
        pub thickness: f64,
        /// Texel widths.
        pub relief: f64,
        /// n.
        pub refractive_index: f64,
        /// GGX width.
        pub roughness: f64,
    }

    /// A layer that cannot be.
    #[derive(Debug, thiserror::Error)]
    #[error("{found} is not at most 1e6")]
    pub struct PaintError {
        found: f64,
    }

    impl Layer {
        /// With the usual binder.
        #[must_use]
        pub fn new(paint: Paint, thickness: f64, relief: f64) -> Self {
            Self { paint, thickness, relief, refractive_index: 1.5, roughness: 0.3 }
        }

        /// Checks.
        ///
        /// # Errors
        /// [`PaintError`].
        pub fn checked(self) -> Result<Self, PaintError> {
            if self.thickness > 1e6 { Err(PaintError { found: 1e6 }) } else { Ok(self) }
        }
    }

    /// Where paint lies.
    #[derive(Debug, Clone, Copy, PartialEq)]
    pub enum Pattern {
        /// Everywhere.
        Uniform,
        /// A splash.
        Splash {
            /// Which.
            seed: u32,
        },
        /// A stroke.
        Brush {
            /// Which.
            seed: u32,
            /// Radians.
            angle: f64,
            /// Part of the shorter edge.
            width: f64,
        },
    }

    /// A pattern that cannot be.
    #[derive(Debug, thiserror::Error)]
    #[error("the width of a brush stroke is {found}")]
    pub struct PatternError {
        found: f64,
    }

    impl Pattern {
        /// Checks.
        ///
        /// # Errors
        /// [`PatternError`].
        pub fn checked(self) -> Result<Self, PatternError> {
            match self {
                Self::Brush { width, .. } if width > 0.5 => Err(PatternError { found: width }),
                _ => Ok(self),
            }
        }
    }

    /// The library.
    pub mod pigments {
        /// A pigment.
        #[derive(Debug)]
        pub struct Pigment {
            /// Its name.
            pub name: &'static str,
        }

        /// No such name.
        #[derive(Debug, thiserror::Error)]
        #[error("no paint is called \"{name}\"")]
        pub struct PigmentError {
            name: String,
        }

        const PIGMENTS: [Pigment; 3] = [
            Pigment { name: "oil/viridian" },
            Pigment { name: "watercolour/cadmium yellow" },
            Pigment { name: "watercolour/cerulean blue" },
        ];

        impl Pigment {
            /// With its set.
            #[must_use]
            pub fn full_name(&self) -> String {
                self.name.to_owned()
            }
        }

        /// All.
        pub fn all() -> impl Iterator<Item = &'static Pigment> {
            PIGMENTS.iter()
        }

        /// By name.
        ///
        /// # Errors
        /// [`PigmentError`].
        pub fn find(name: &str) -> Result<&'static Pigment, PigmentError> {
            let wanted = name.to_lowercase();
            all().find(|pigment| pigment.name.ends_with(&wanted)).ok_or_else(|| PigmentError { name: name.to_owned() })
        }
    }
}

use crate::{
    data::{Direction, Fit, Map, Material, Provenance, Svbrdf},
    gpu::{Gpu, GpuError},
    model::{FitSettings, Layer, Pattern},
    pipeline::Progress,
};

/// A job's error.
#[derive(Debug, thiserror::Error)]
pub enum PipelineError {
    /// On the adapter.
    #[error(transparent)]
    Gpu(#[from] GpuError),
    /// Reading or writing.
    #[error(transparent)]
    Io(#[from] io::IoError),
    /// A file of the report could not be written.
    #[error("{path} could not be written. Check the folder's permissions and the space left", path = path.display())]
    Write {
        /// The file.
        path: std::path::PathBuf,
        /// The system's reason.
        source: std::io::Error,
    },
}

fn flat() -> Material {
    Material {
        height: Map::from_fn(64, 64, |column, row| ((column + row) % 16) as f32),
        normal: Map::from_fn(64, 64, |_, _| [0.0, 0.0, 1.0]),
        normal_measured: Map::from_fn(64, 64, |_, _| [0.0, 0.0, 1.0]),
        albedo: Map::from_fn(64, 64, |_, _| 0.5),
        svbrdf: Svbrdf {
            diffuse: Map::from_fn(64, 64, |_, _| [0.5; 3]),
            specular: Map::from_fn(64, 64, |_, _| [0.1; 3]),
            lobe: Map::from_fn(64, 64, |_, _| [-1.0, -1.0, 1.0, 10.0]),
        },
        fit: Fit {
            objective_start: Map::from_fn(64, 64, |_, _| 1.0),
            objective: Map::from_fn(64, 64, |_, _| 0.1),
            iterations: Map::from_fn(64, 64, |_, _| 20),
            status: Map::from_fn(64, 64, |_, _| 1),
        },
        provenance: Provenance {
            source: "stand-in".to_owned(),
            views: 51,
            lights: 51,
            samples: 2601,
            adapter: "none".to_owned(),
            version: env!("CARGO_PKG_VERSION").to_owned(),
            settings: FitSettings::default(),
        },
    }
}

/// Fits.
///
/// # Errors
/// [`PipelineError`].
pub fn fit(gpu: &Gpu, source: &dyn io::Source, settings: &FitSettings, progress: &Progress) -> Result<Material, PipelineError> {
    let stage = progress.stage("lafortune_fit", source.btf().texels(), source.btf().pairs().len());
    progress.expect(1);
    stage.gpu(&gpu.submit(gpu.recorder()).wait(gpu)?);
    progress.advance(1);
    let mut material = flat();
    material.provenance.settings = *settings;
    Ok(material)
}

/// A coat of paint.
#[derive(Debug, Clone)]
pub struct Coat {
    /// The paint.
    pub layer: Layer,
    /// Where it lies.
    pub pattern: Pattern,
}

/// Makes pictures.
#[derive(Debug)]
pub struct Studio<'g>(&'g Gpu);

impl<'g> Studio<'g> {
    /// Opens.
    ///
    /// # Errors
    /// [`PipelineError`].
    pub fn new(gpu: &'g Gpu) -> Result<Self, PipelineError> {
        Ok(Self(gpu))
    }

    /// One pixel a texel.
    ///
    /// # Errors
    /// [`PipelineError`].
    pub fn reconstruct(
        &self, material: &Material, _view: Direction, light: Direction, progress: &Progress,
    ) -> Result<Map<[f32; 4]>, PipelineError> {
        let stage = progress.stage("reconstruct", material.height.values().len(), 0);
        stage.gpu(&self.0.submit(self.0.recorder()).wait(self.0)?);
        let shade = 0.5 * light.theta.cos() as f32;
        Ok(Map::from_fn(64, 64, |_, _| [shade, shade, shade, 1.0]))
    }

    /// A plane in perspective.
    ///
    /// # Errors
    /// [`PipelineError`].
    pub fn render(
        &self, _material: &Material, paint: Option<&Coat>, _view: Direction, _light: Direction, [width, height]: [u32; 2],
        progress: &Progress,
    ) -> Result<Map<[f32; 4]>, PipelineError> {
        let stage = progress.stage("render", 4096, 0);
        stage.gpu(&[]);
        let shade = if paint.is_some() { 0.5 } else { 0.2 };
        Ok(Map::from_fn(width as usize, height as usize, |_, _| [shade, shade, shade, 1.0]))
    }
}
