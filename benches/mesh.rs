//! Time of a picture of a mesh and of its shadow maps, by what its bare part is made from, by texel samples, by relief and by pixels, and which part of the
//! adapter's rates its loads and arithmetic reach at most: `cargo bench --bench mesh -- [MESH…]`, of the built-in shapes and of those files. The material
//! is the sample inside the program, fitted first; painted it has the thesis' four layers (fig. 4.15). The best of three pictures at 768 x 768,
//! one ray a pixel, under two lights.

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
    println!("{:<44}{:>8}{:>10}{:>12}{:>12}", "", "ms", "pixels", "ns a pixel", "frames/s");
    for (name, mesh) in &meshes {
        for (material, what) in [(&bare, "bare"), (&painted, "painted")] {
            for unpainted in [None, Some(TexelSamples::Five)] {
                let of = if unpainted.is_some() { "local PCA" } else { "reflectance" };
                bench.time(&format!("{name}, {what}, {of}"), &view(mesh, unpainted, SIZE), material)?;
            }
        }
    }
    println!("by texel samples, sphere, bare");
    let sphere = Shape::Sphere.mesh();
    for samples in [TexelSamples::One, TexelSamples::Five, TexelSamples::Nine, TexelSamples::TwentyFive] {
        let seconds = bench.time(&format!("{} texels", samples.count()), &view(&sphere, Some(samples), SIZE), &bare)?;
        bench.share(&material, samples, seconds);
    }
    println!("by relief, sphere, painted, reflectance");
    let whole = Relief::default();
    for (what, relief) in [
        ("no relief", Relief { displace: false, shadow: false, ..whole }),
        ("displaced", Relief { shadow: false, ..whole }),
        ("displaced and shadowed", whole),
    ] {
        bench.time(what, &MeshView { relief, ..view(&sphere, None, SIZE) }, &painted)?;
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

struct Bench<'g> {
    gpu: &'g Gpu,
    studio: Studio<'g>,
    renderer: Renderer<'g>,
    rates: Rates,
}

impl Bench<'_> {
    /// Prints the best time of a picture, and of its shadow maps; returns the seconds that a pixel of the mesh takes.
    fn time(&self, what: &str, view: &MeshView, material: &Material) -> Result<f64, Box<dyn Error>> {
        let progress = Progress::new(self.gpu.adapter());
        let mut dressed = self.renderer.dress(&self.studio, view, material, &progress)?;
        let (mut picture, mut shadows, mut covered) = (f64::INFINITY, f64::INFINITY, 0);
        for _ in 0..3 {
            let start = Instant::now();
            self.renderer.relight(&mut dressed, view, &progress)?;
            shadows = shadows.min(start.elapsed().as_secs_f64());
            let start = Instant::now();
            let pixels = self.renderer.radiance(&dressed, &view.camera, &progress)?;
            picture = picture.min(start.elapsed().as_secs_f64());
            covered = pixels.values().iter().filter(|pixel| pixel[3] > 0.0).count();
        }
        let each = picture / covered as f64;
        println!(
            "{what:<44}{:>8.1}{covered:>10}{:>12.0}{:>12.1}   shadow maps {:.1} ms",
            1e3 * picture,
            1e9 * each,
            1.0 / picture,
            1e3 * shadows
        );
        Ok(each)
    }

    /// Prints the part of the adapter's rates that looking up the local PCA reaches, the whole picture's time taken for it and every pixel lit by both
    /// lights.
    fn share(&self, material: &Material, samples: TexelSamples, seconds: f64) {
        let Some(lpca) = &material.lpca else { return };
        // Of two lights: each texel its words, and each cluster of a place nine pairs of all terms, of which there is one at least.
        let terms = 1.0 + lpca.components as f64;
        let loads = 2.0 * (f64::from(samples.count()) * (4.0 + 2.0 * terms) + 9.0 * terms * 8.0);
        let arithmetic = 2.0 * (f64::from(samples.count()) * terms * 2.0 + 9.0 * terms * 6.0);
        println!(
            "{:<44}at most {:.1} % of the load rate, {:.1} % of the arithmetic",
            "",
            100.0 * loads / seconds / self.rates.loads,
            100.0 * arithmetic / seconds / self.rates.arithmetic
        );
    }
}
