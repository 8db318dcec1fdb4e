//! Small containers of every kind, with the values they stand for.

use half::f16;

use crate::support::random::Random;

/// A file under construction.
#[derive(Clone)]
pub struct File {
    pub bytes: Vec<u8>,
    /// Fields and where they are.
    marks: Vec<(&'static str, usize)>,
    /// Stored values, `[sample][channel][texel]`, after colours and logarithms are undone.
    pub stored: Vec<f64>,
}

impl File {
    fn new(signature: &str) -> Self {
        Self { bytes: signature.as_bytes().to_vec(), marks: Vec::new(), stored: Vec::new() }
    }

    fn mark(&mut self, field: &'static str) -> &mut Self {
        self.marks.push((field, self.bytes.len()));
        self
    }

    fn u8(&mut self, value: u8) {
        self.bytes.push(value);
    }

    fn u32(&mut self, value: usize) {
        self.bytes.extend(u32::try_from(value).expect("is small").to_le_bytes());
    }

    fn f32(&mut self, value: f32) {
        self.bytes.extend(value.to_le_bytes());
    }

    fn text(&mut self, text: &str) {
        self.u32(text.len());
        self.bytes.extend(text.as_bytes());
    }

    /// Stores scalars of the given size and gives them as they are then.
    fn scalars(&mut self, size: u8, values: &[f64]) -> Vec<f64> {
        let store = |&value: &f64| match size {
            2 => {
                self.bytes.extend(f16::from_f64(value).to_le_bytes());
                f16::from_f64(value).to_f64()
            }
            4 => {
                self.bytes.extend((value as f32).to_le_bytes());
                f64::from(value as f32)
            }
            _ => {
                self.bytes.extend(value.to_le_bytes());
                value
            }
        };
        values.iter().map(store).collect()
    }

    /// Names of the fields.
    pub fn marks(&self) -> Vec<&'static str> {
        self.marks.iter().map(|(name, _)| *name).collect()
    }

    /// Where the `nth` field of that name is.
    #[track_caller]
    pub fn at(&self, field: &str, nth: usize) -> usize {
        self.marks.iter().filter(|(name, _)| *name == field).nth(nth).unwrap_or_else(|| panic!("no {field}")).1
    }

    /// The same file with other bytes in a field.
    #[track_caller]
    pub fn with(&self, field: &str, bytes: &[u8]) -> Vec<u8> {
        let at = self.at(field, 0);
        let mut file = self.bytes.clone();
        file[at..at + bytes.len()].copy_from_slice(bytes);
        file
    }
}

/// What all kinds start with.
#[derive(Clone)]
pub struct Scene {
    /// θ and φ in radians.
    pub views: Vec<[f32; 2]>,
    pub lights: Vec<[f32; 2]>,
    pub size: [usize; 2],
    pub version: usize,
    pub cosine: usize,
    pub rotations: usize,
    pub channels: Vec<&'static str>,
}

impl Default for Scene {
    fn default() -> Self {
        Self {
            views: vec![[0.0, 0.0], [0.5, 1.0]],
            lights: vec![[0.0, 0.0], [0.5, 1.0], [1.2, -2.0]],
            size: [5, 4],
            version: 4,
            cosine: 1,
            rotations: 2,
            channels: vec!["R", "G", "B"],
        }
    }
}

impl Scene {
    pub fn samples(&self) -> usize {
        self.views.len() * self.lights.len()
    }

    pub fn texels(&self) -> usize {
        self.size[0] * self.size[1]
    }

    fn meta(&self, file: &mut File) {
        let start = file.mark("meta size").bytes.len();
        file.u32(0);
        file.mark("meta version").u32(self.version);
        for text in ["setup", "sensor", "light"] {
            file.bytes.extend(text.bytes().chain(std::iter::repeat(0)).take(80));
        }
        for value in [7.5, 1.0, 2.0, 3.0] {
            file.f32(value);
        }
        if self.version > 1 {
            file.u32(self.cosine);
        }
        if self.version > 2 {
            file.mark("xml").text("<m/>");
        }
        if self.version > 3 {
            file.mark("channels").u32(self.channels.len());
            self.channels.iter().for_each(|name| file.mark("channel").text(name));
        }
        let size = u32::try_from(file.bytes.len() - start).expect("is small");
        file.bytes[start..start + 4].copy_from_slice(&size.to_le_bytes());
    }

    fn directions(&self, file: &mut File) {
        file.mark("views").u32(self.views.len());
        for view in &self.views {
            file.mark("view");
            view.iter().for_each(|&angle| file.f32(angle));
            file.mark("lights").u32(self.lights.len());
            for light in &self.lights {
                file.mark("light");
                light.iter().for_each(|&angle| file.f32(angle));
            }
        }
    }

    fn size(&self, file: &mut File) {
        file.mark("width").u32(self.size[0]);
        file.mark("height").u32(self.size[1]);
    }

    fn rotations(&self, file: &mut File) {
        file.mark("rotations").u32(self.rotations);
        (0..9 * self.rotations).for_each(|index| file.f32(index as f32));
    }

    /// META, BIDIR, size, and rotations after a signature that ends in R.
    fn common(&self, signature: &str) -> File {
        let mut file = File::new(signature);
        self.meta(&mut file);
        self.directions(&mut file);
        self.size(&mut file);
        if signature.ends_with('R') {
            self.rotations(&mut file);
        }
        file
    }
}

/// Components of a product.
const COMPONENTS: usize = 6;

/// How matrices are stored.
#[derive(Debug, Clone, Copy)]
pub struct Storage {
    /// Bytes of a scalar.
    pub scalar: u8,
    pub transposed: bool,
}

/// Writes a product of two random matrices and gives (rows, columns, value).
fn product(file: &mut File, random: &mut Random, scalar: u8, [rows, columns]: [usize; 2]) -> impl Fn(usize, usize) -> f64 + use<> {
    file.mark("scalar").u8(scalar);
    file.mark("components").u32(COMPONENTS);
    file.mark("rows").u32(rows);
    file.mark("columns").u32(columns);
    let mut table = |rows: usize, low: f64, high: f64| {
        let values: Vec<f64> = (0..rows * COMPONENTS).map(|_| random.between(low, high)).collect();
        file.scalars(scalar, &values)
    };
    table(1, 0.0, 1.0);
    let (u, sv) = (table(rows, -0.5, 0.8), table(columns, -0.5, 0.8));
    move |row, column| (0..COMPONENTS).map(|k| u[row * COMPONENTS + k] * sv[column * COMPONENTS + k]).sum()
}

/// All values, `[sample][channel][texel]`.
fn values(scene: &Scene, mut rgb: impl FnMut(usize, usize) -> [f64; 3]) -> Vec<f64> {
    (0..scene.samples())
        .flat_map(|sample| {
            let texels: Vec<[f64; 3]> = (0..scene.texels()).map(|texel| rgb(sample, texel)).collect();
            (0..3).flat_map(move |channel| texels.clone().into_iter().map(move |rgb| rgb[channel]))
        })
        .collect()
}

/// FMF. With a version of the extended header (and a height map where it can have one), or without.
pub fn fmf(scene: &Scene, rotated: bool, extended: Option<(u8, bool)>, storage: Storage) -> File {
    let signature = if extended.is_some() { "!FMF12FCE" } else { "!FMF06FC" };
    let mut file = scene.common(&format!("{signature}{}", if rotated { "R" } else { "" }));
    let mut logarithm = false;
    if let Some((version, reduced)) = extended {
        file.mark("header version").u8(version);
        if version >= 1 {
            file.mark("reduction").u32(usize::from(reduced));
            logarithm = reduced;
        }
        if version >= 2 {
            file.mark("height map").u32(3);
            file.u32(2);
            file.bytes.extend([7; 12]);
        }
    }
    file.u32(COMPONENTS);
    let (samples, texels) = (scene.samples(), scene.texels());
    let sizes = if storage.transposed { [3 * texels, samples] } else { [3 * samples, texels] };
    let value = product(&mut file, &mut Random::new(11), storage.scalar, sizes);
    file.stored = values(scene, |sample, texel| {
        [0, 1, 2].map(|c| {
            let v = if storage.transposed { value(c + 3 * texel, sample) } else { value(c + 3 * sample, texel) };
            if logarithm { v.exp() - 1e-5 } else { v }
        })
    });
    file
}

/// RGB as the colour models have it, written out.
fn rgb_of(model: i32, [a, b, c]: [f64; 3]) -> [f64; 3] {
    let of_yuv = |y: f64, u: f64, v: f64| [y + 1.13983 * v, y - 0.39465 * u - 0.5806 * v, y + 2.03211 * u];
    let t = TRANSFORM.map(f64::from);
    match model {
        0 => [a, b, c],
        1 => of_yuv(a, b, c),
        3 => [a * t[3] + b * t[6] + c * t[9] + t[0], a * t[4] + b * t[7] + c * t[10] + t[1], a * t[5] + b * t[8] + c * t[11] + t[2]],
        4 => [a + b - c, a + c, a - b - c],
        _ => {
            let y = a.exp() - 1e-5;
            of_yuv(y, b * (y + 1e-5), c * (y + 1e-5))
        }
    }
}

/// Mean and transform of colours.
const TRANSFORM: [f32; 12] = [0.1, 0.2, 0.3, 0.9, -0.2, 0.4, 0.3, 0.8, -0.5, 0.1, 0.6, 0.7];

/// DFMF; each channel may have scalars and an order of its own.
pub fn dfmf(scene: &Scene, rotated: bool, model: i32, storage: [Storage; 3]) -> File {
    let mut file = scene.common(if rotated { "!DFMF08FCR" } else { "!DFMF08FC" });
    file.u32(COMPONENTS);
    file.mark("model").bytes.extend(model.to_le_bytes());
    TRANSFORM.iter().for_each(|&value| file.f32(value));
    let (samples, texels) = (scene.samples(), scene.texels());
    let mut random = Random::new(12);
    let channels = storage.map(|storage| {
        let sizes = if storage.transposed { [texels, samples] } else { [samples, texels] };
        let value = product(&mut file, &mut random, storage.scalar, sizes);
        move |sample, texel| if storage.transposed { value(texel, sample) } else { value(sample, texel) }
    });
    file.stored = values(scene, |sample, texel| rgb_of(model, [0, 1, 2].map(|c| channels[c](sample, texel))));
    file
}

/// PVF, with the older header or the newer.
pub fn pvf(scene: &Scene, rotated: bool, legacy: bool, storage: Storage) -> File {
    let signature = if rotated { "!PVF06FCR" } else { "!PVF06FC" };
    let mut file = if legacy { File::new(signature) } else { scene.common(signature) };
    if legacy {
        file.bytes.extend(301_074_i32.to_le_bytes());
        file.u32(COMPONENTS);
        scene.size(&mut file);
        file.mark("slots").u32(scene.views.len());
        scene.directions(&mut file);
    } else {
        file.u32(COMPONENTS);
        file.mark("slots").u32(scene.views.len());
    }
    let (lights, texels, scalar) = (scene.lights.len(), scene.texels(), storage.scalar);
    let [weights, dimension] = if storage.transposed { [lights, 3 * texels] } else { [texels, 3 * lights] };
    let mut random = Random::new(13);
    let views: Vec<_> = (0..scene.views.len())
        .map(|_| {
            file.mark("scalar").u8(scalar);
            file.mark("components").u32(COMPONENTS);
            file.mark("weights").u32(weights);
            file.mark("dimension").u32(dimension);
            let mut table = |count: usize| {
                let values: Vec<f64> = (0..count).map(|_| random.between(-0.5, 0.8)).collect();
                file.scalars(scalar, &values)
            };
            table(COMPONENTS);
            let (mean, c, w) = (table(dimension), table(dimension * COMPONENTS), table(weights * COMPONENTS));
            move |weight: usize, at: usize| {
                mean[at] + (0..COMPONENTS).map(|k| w[weight * COMPONENTS + k] * c[at * COMPONENTS + k]).sum::<f64>()
            }
        })
        .collect();
    file.stored = values(scene, |sample, texel| {
        let (view, light) = (sample / lights, sample % lights);
        [0, 1, 2].map(
            |channel| if storage.transposed { views[view](light, channel + 3 * texel) } else { views[view](texel, channel + 3 * light) },
        )
    });
    file
}

/// The header of a BDI with chunks of `lines` rows.
pub fn bdi_header(scene: &Scene, lines: usize, mask: &[u8], sparse: bool) -> File {
    let mut file = File::new("!BDIF06R2!");
    scene.meta(&mut file);
    scene.directions(&mut file);
    scene.size(&mut file);
    file.mark("lines").u32(lines);
    file.mark("compression").u8(if sparse { 2 } else { 0 });
    file.mark("mask").bytes.extend(mask);
    scene.rotations(&mut file);
    file
}

/// BDI with chunks of `lines` rows and a mask. In sparse ones the chunks are filled up, or with `by_rows` each has what its rows have.
pub fn bdi(scene: &Scene, lines: usize, mask: &[u8], sparse: bool, by_rows: bool) -> File {
    let mut file = bdi_header(scene, lines, mask, sparse);
    let mut random = Random::new(14);
    file.stored = values(scene, |_, _| [(); 3].map(|()| f16::from_f64(random_between(&mut random)).to_f64()));
    let (texels, samples) = (scene.texels(), scene.samples());
    let texel = |texel: usize| (0..samples).flat_map(move |sample| (0..3).map(move |c| (3 * sample + c) * texels + texel));
    let per_chunk = lines * scene.size[0];
    let is_stored = |texel: &usize| !sparse || mask[*texel] != 0;
    let chunks: Vec<Vec<usize>> = if by_rows {
        (0..texels).collect::<Vec<_>>().chunks(per_chunk).map(|chunk| chunk.iter().copied().filter(is_stored).collect()).collect()
    } else {
        (0..texels).filter(is_stored).collect::<Vec<_>>().chunks(per_chunk).map(<[usize]>::to_vec).collect()
    };
    for chunk in chunks {
        file.mark("chunk").u32(chunk.len() * samples * 6);
        for value in chunk.into_iter().flat_map(texel) {
            let half = f16::from_f64(file.stored[value]);
            file.bytes.extend(half.to_le_bytes());
        }
    }
    for (at, value) in file.stored.iter_mut().enumerate() {
        if mask[at % texels] == 0 {
            *value = f64::NAN;
        }
    }
    file
}

/// Also negative ones: they are measurements.
fn random_between(random: &mut Random) -> f64 {
    random.between(-0.2, 3.0)
}
