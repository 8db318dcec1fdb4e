//! Time of a picture of a mesh, pass by pass, by what its bare part is made from, by texel samples, by relief and by pixels, and which part of
//! the adapter's rates its loads and arithmetic reach: `cargo bench --bench mesh -- [MESH…]`, of the built-in shapes and of those files. The
//! material is the sample inside the program, fitted first; painted it has the thesis' four layers (fig. 4.15). The better of two pictures at
//! 768 x 768, one ray a pixel, under two lights: the first of a kind has the driver compile.

use std::{env, error::Error, path::Path, time::Instant};

use overpaint::{
    data::{Camera, Light, Material, Mesh, MeshView, Recipe, Sampling, Shape},
    gpu::Gpu,
    io,
    model::{Layer, Paint, PaintMethod, Relief, TexelSamples, pigments},
    pipeline::{Painter, Pictured, Progress, Renderer, Studio},
};

mod layers;
mod rates;
use layers::LAYERS;
use rates::Rates;

const SIZE: [u32; 2] = [768, 768];

fn main() -> Result<(), Box<dyn Error>> {
    let gpu = Gpu::open(env::var("OVERPAINT_ADAPTER").ok().as_deref())?;
    let rates = Rates::of(&gpu)?;
    println!(
        "adapter: {}; {:.1} GFLOP/s of multiply-adds, {:.2} GB/s of loads in order",
        gpu.adapter().name,
        rates.arithmetic / 1e9,
        rates.loads / 1e9
    );
    let progress = Progress::new(gpu.adapter());
    let Pictured { material, .. } = Pictured::sample(&gpu, &progress)?;
    let layers =
        LAYERS.map(|(name, pattern)| pigments::find(name).map(|pigment| Layer { pattern, ..Layer::new(Paint::from(pigment), 2.0, 1.0) }));
    let recipe = Recipe { repeat: [4, 4], layers: layers.into_iter().collect::<Result<_, _>>()?, images: Vec::new() };
    let painted = Painter::new(&gpu)?.paint(&material, &recipe, PaintMethod::KubelkaMunk, &progress)?;
    let bare = Material { painted: None, ..painted.clone() };

    let mut meshes: Vec<(String, Mesh)> = Shape::ALL.map(|shape| (shape.name().to_owned(), shape.mesh())).to_vec();
    for path in env::args().skip(1).filter(|argument| !argument.starts_with("--")) {
        meshes.push((path.clone(), io::mesh::load(Path::new(&path))?.mesh));
    }
    let bench = Bench { gpu: &gpu, studio: Studio::new(&gpu)?, renderer: Renderer::new(&gpu)?, rates };
    println!("{:<44}{:>9}{:>9}{:>9}{:>9}{:>9}{:>12}{:>10}", "", "ms", "shadow", "hit", "shade", "pixels", "ns a pixel", "frames/s");
    for (name, mesh) in &meshes {
        for (material, what) in [(&bare, "bare"), (&painted, "painted")] {
            for unpainted in [None, Some(TexelSamples::Five)] {
                let of = if unpainted.is_some() { "local PCA" } else { "reflectance" };
                bench.time(&format!("{name}, {what}, {of}"), &view(mesh, unpainted, SIZE), material)?;
            }
        }
    }
    println!("by texel samples, bare");
    for (name, mesh) in &meshes[..2] {
        for samples in TexelSamples::ALL {
            let shaded = bench.time(&format!("{name}, {} texels", samples.count()), &view(mesh, Some(samples), SIZE), &bare)?;
            if Shape::Plane.name() == name {
                bench.share(&material, samples, shaded);
            }
        }
    }
    let sphere = Shape::Sphere.mesh();
    println!("by relief, sphere, painted, reflectance");
    let whole = Relief::default();
    for (what, relief) in [
        ("no relief", Relief { displace: false, shadow: false, ..whole }),
        ("displaced", Relief { shadow: false, ..whole }),
        ("displaced and shadowed", whole),
    ] {
        bench.time(what, &MeshView { relief, ..view(&sphere, None, SIZE) }, &painted)?;
    }
    println!("by height of the relief, and so by steps, sphere, painted, reflectance");
    for factor in [0.0, 0.5, 1.0, 2.0, 4.0] {
        let scaled = scaled(&painted, factor);
        let [lowest, highest] = scaled.height.values().iter().fold([f32::MAX, f32::MIN], |[low, high], &h| [low.min(h), high.max(h)]);
        bench.time(
            &format!("{factor} times, {:.2} texels from lowest to highest", highest - lowest),
            &view(&sphere, None, SIZE),
            &scaled,
        )?;
    }
    println!("by pixels, sphere, painted, local PCA");
    for side in [192, 384, 768, 1536] {
        bench.time(&format!("{side} x {side}"), &view(&sphere, Some(TexelSamples::Five), [side; 2]), &painted)?;
    }
    Ok(())
}

fn view(mesh: &Mesh, unpainted: Option<TexelSamples>, size: [u32; 2]) -> MeshView {
    let camera = Camera::showing(mesh, MeshView::BEARING, MeshView::ANGLE_OF_VIEW, size, false);
    MeshView { unpainted, sampling: Sampling { rays: 1, pictures: 1 }, ..MeshView::new(mesh.clone(), camera, Light::pair()) }
}

/// The material with `factor` times its relief.
fn scaled(material: &Material, factor: f32) -> Material {
    let mut scaled = material.clone();
    scaled.height = scaled.height.map(|height| factor * height);
    if let Some(painted) = &mut scaled.painted {
        painted.height = painted.height.map(|height| factor * height);
    }
    scaled
}

struct Bench<'g> {
    gpu: &'g Gpu,
    studio: Studio<'g>,
    renderer: Renderer<'g>,
    rates: Rates,
}

impl Bench<'_> {
    /// Prints the better time of two pictures and of their passes; returns the seconds that shading a pixel of the mesh takes.
    fn time(&self, what: &str, view: &MeshView, material: &Material) -> Result<f64, Box<dyn Error>> {
        let quiet = Progress::new(self.gpu.adapter());
        let mut dressed = self.renderer.dress(&self.studio, view, material, &quiet)?;
        let (mut best, mut passes, mut covered) = (f64::INFINITY, [0.0; 3], 0);
        for _ in 0..2 {
            let progress = Progress::new(self.gpu.adapter());
            let start = Instant::now();
            self.renderer.relight(&mut dressed, view, &progress)?;
            let pixels = self.renderer.radiance(&dressed, &view.camera, &progress)?;
            let seconds = start.elapsed().as_secs_f64();
            if seconds < best {
                best = seconds;
                let stages = progress.report().stages;
                let of = |name| stages.iter().filter(|stage| stage.name == name).map(|stage| stage.wall_seconds).sum();
                passes = ["shadow", "mesh_hit", "mesh"].map(of);
                covered = pixels.values().iter().filter(|pixel| pixel[3] > 0.0).count();
            }
        }
        let [shadow, hit, shade] = passes;
        println!(
            "{what:<44}{:>9.1}{:>9.1}{:>9.1}{:>9.1}{covered:>9}{:>12.0}{:>10.2}",
            1e3 * best,
            1e3 * shadow,
            1e3 * hit,
            1e3 * shade,
            1e9 * best / covered as f64,
            1.0 / best
        );
        Ok(shade / covered as f64)
    }

    /// Prints the part of the adapter's rates that looking up the local PCA reaches on a plane, all of whose pixels both lights reach, all of a
    /// pixel's time to shade it taken for it.
    fn share(&self, material: &Material, samples: TexelSamples, seconds: f64) {
        let Some(lpca) = &material.lpca else { return };
        // Of two lights: each texel its words, and each cluster of a place nine pairs of all terms, of which there is one at least.
        let terms = 1.0 + lpca.components as f64;
        let loads = 2.0 * (f64::from(samples.count()) * (4.0 + 2.0 * terms) + 9.0 * terms * 8.0);
        let arithmetic = 2.0 * (f64::from(samples.count()) * terms * 2.0 + 9.0 * terms * 6.0);
        println!(
            "{:<44}at least {:.2} % of the load rate, {:.2} % of the arithmetic",
            "",
            100.0 * loads / seconds / self.rates.loads,
            100.0 * arithmetic / seconds / self.rates.arithmetic
        );
    }
}
