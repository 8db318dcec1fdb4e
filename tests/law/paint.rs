use overpaint::{
    data::{Direction, Map, Material, PlaneView, Recipe},
    gpu::Gpu,
    io::material,
    model::{HeightField, Layer, Paint, PaintMethod, Pattern, Relief, Synth, SynthReflectance, pigments},
    pipeline::{FIGURES, FigureSettings, Pictured, Painter, Progress, Studio, Synthetic, figures, swatches},
};

use crate::support::{Worst, hold};

crate::suite! {
    gpu: a_layer_of_no_thickness_is_the_bare_material, a_stored_material_gives_the_same_picture, paint_goes_on_top_of_paint,
        thick_paint_keeps_shading_and_a_blended_colour_does_not, a_painted_piece_repeats, what_cannot_be_painted_is_told, swatches_are_films_over_their_grounds,
        figures_are_made_of_every_material;
}

const VIEW: (f64, f64) = (35.0, 250.0);
const LIGHT: (f64, f64) = (55.0, 120.0);

/// Made bumps of 48 x 32 texels.
fn bumps(gpu: &Gpu) -> Material {
    let recipe = Synth { height_field: HeightField::Bumps, relief: 3.0, reflectance: SynthReflectance::Matte, seed: 4 };
    let zenith = vec![Direction::from_degrees(0.0, 0.0)];
    let made = Synthetic::new(gpu, "bumps", recipe, [48, 32], zenith.clone(), zenith, &Progress::new(gpu.adapter()));
    made.expect("is made").truth()
}

fn layer(name: &str, thickness: f64, relief: f64, pattern: Pattern) -> Layer {
    Layer { pattern, ..Layer::new(Paint::from(pigments::find(name).expect("is in the library")), thickness, relief) }
}

fn of(layers: &[Layer]) -> Recipe {
    Recipe { repeat: [1, 1], layers: layers.to_vec(), images: Vec::new() }
}

fn painted(gpu: &Gpu, material: &Material, recipe: &Recipe, method: PaintMethod) -> Material {
    let progress = Progress::new(gpu.adapter());
    Painter::new(gpu).expect("builds").paint(material, recipe, method, &progress).expect("paints")
}

/// The material seen as its source would see it, and as a plane in space.
fn pictures(gpu: &Gpu, material: &Material) -> [Map<[f32; 4]>; 2] {
    let (studio, progress) = (Studio::new(gpu).expect("builds"), Progress::new(gpu.adapter()));
    let surface = studio.surface(material, &progress).expect("fits");
    let [view, light] = [VIEW, LIGHT].map(|(theta, phi)| Direction::from_degrees(theta, phi));
    let shot = PlaneView::new(view, light, [64, 48]);
    [
        studio.reconstruct(&surface, view, light, Relief::default(), &progress).expect("fits"),
        studio.render(&surface, &shot, Relief::default(), &progress).expect("fits"),
    ]
}

const SPLASH: Pattern = Pattern::Splash { seed: 3 };

fn a_layer_of_no_thickness_is_the_bare_material(gpu: &Gpu) {
    let bare = bumps(gpu);
    let nothing = of(&[layer("oil/viridian", 3.0, 2.0, Pattern::Uniform { drawn: 0.0 })]);
    for method in [PaintMethod::KubelkaMunk, PaintMethod::AlphaBlend] {
        assert!(pictures(gpu, &painted(gpu, &bare, &nothing, method)) == pictures(gpu, &bare));
    }
}

fn a_stored_material_gives_the_same_picture(gpu: &Gpu) {
    let recipe = of(&[layer("oil/viridian", 3.0, 2.0, SPLASH), layer("watercolour/cerulean blue", 0.4, 0.1, Pattern::Brush { seed: 2, width: 0.3 })]);
    let folder = tempfile::tempdir().expect("is made");
    for method in [PaintMethod::KubelkaMunk, PaintMethod::AlphaBlend] {
        let painted = painted(gpu, &bumps(gpu), &recipe, method);
        let path = folder.path().join("painted.zarr");
        material::save(&path, &painted).expect("saves");
        let loaded = material::load(&path).expect("loads");
        assert_eq!(loaded.painted.as_ref().expect("is there").layers, recipe.layers);
        assert!(pictures(gpu, &loaded) == pictures(gpu, &painted));
    }
}

/// Two recipes one after the other are one recipe of both, but for what the first leaves above 1, of which there is nothing here.
fn paint_goes_on_top_of_paint(gpu: &Gpu) {
    let layers = [layer("oil/viridian", 1.0, 2.0, SPLASH), layer("watercolour/cerulean blue", 0.4, 0.5, Pattern::Splash { seed: 8 })];
    let at_once = painted(gpu, &bumps(gpu), &of(&layers), PaintMethod::KubelkaMunk);
    let first = painted(gpu, &bumps(gpu), &of(&layers[..1]), PaintMethod::KubelkaMunk);
    let then = painted(gpu, &first, &of(&layers[1..]), PaintMethod::KubelkaMunk);
    let [at_once, then] = [at_once, then].map(|material| material.painted.expect("is there"));
    assert_eq!((&at_once.layers, &at_once.height), (&then.layers, &then.height));
    let pairs = at_once.reflectance.values().iter().flatten().zip(then.reflectance.values().iter().flatten());
    // What is stored between them is what the kernel holds in its registers; a driver may contract a product and a sum otherwise.
    hold("paint: one recipe after the other", pairs.map(|(a, b)| (a - b).abs()).worst(), 1e-7);
    let pairs = at_once.coverage.values().iter().zip(then.coverage.values());
    hold("paint: their coverage", pairs.map(|(a, b)| (a - b).abs()).worst(), 1e-7);
    let pairs = at_once.coat.values().iter().flatten().zip(then.coat.values().iter().flatten());
    hold("paint: their coats", pairs.map(|(a, b)| (a - b).abs()).worst(), 1e-7);
}

/// Root mean square over the mean of the green channel, less its mean.
fn contrast(picture: &Map<[f32; 4]>) -> f64 {
    let greens: Vec<_> = picture.values().iter().map(|pixel| f64::from(pixel[1])).collect();
    let mean = greens.iter().sum::<f64>() / greens.len() as f64;
    (greens.iter().map(|green| (green - mean).powi(2)).sum::<f64>() / greens.len() as f64).sqrt() / mean
}

/// Under an opaque coat of even colour what is left of the bumps is its relief: as paint it shades, as a blended colour nothing does.
fn thick_paint_keeps_shading_and_a_blended_colour_does_not(gpu: &Gpu) {
    let coat = of(&[layer("oil/titanium white", 100.0, 0.0, Pattern::Uniform { drawn: 1.0 })]);
    let [bare, _] = pictures(gpu, &bumps(gpu));
    let [paint, _] = pictures(gpu, &painted(gpu, &bumps(gpu), &coat, PaintMethod::KubelkaMunk));
    let [colour, _] = pictures(gpu, &painted(gpu, &bumps(gpu), &coat, PaintMethod::AlphaBlend));
assert!(contrast(&paint) > 0.3 * contrast(&bare), "{} of {}", contrast(&paint), contrast(&bare));
    // Roundings of one value that all pixels have: the bilinear weights of four texels.
    hold("paint: contrast of a blended colour", contrast(&colour), 1e-6);
    let cosine = LIGHT.0.to_radians().cos();
    let expected = coat.layers[0].colour()[1] * cosine;
    hold("paint: a blended colour", (f64::from(colour[(3, 4)][1]) - expected).abs(), 1e-6);
}

/// Two pieces beside each other under a pattern of two cells: the second half is the first.
fn a_painted_piece_repeats(gpu: &Gpu) {
    let mut splash = layer("oil/viridian", 3.0, 2.0, SPLASH);
    splash.placement.tiling = [2, 1];
    let twice = painted(gpu, &bumps(gpu), &Recipe { repeat: [2, 1], ..of(&[splash.clone()]) }, PaintMethod::KubelkaMunk);
    assert_eq!(twice.size(), [96, 32]);
    splash.placement.tiling = [1, 1];
    let once = painted(gpu, &bumps(gpu), &of(&[splash]), PaintMethod::KubelkaMunk);
    let [twice, once] = [twice, once].map(|material| material.painted.expect("is there"));
    let pairs = (0..96 * 32).map(|texel| (twice.reflectance[(texel % 96, texel / 96)], once.reflectance[(texel % 48, texel / 96)]));
    // Places in the cell round differently; a splash's edge has a slope of 2/0.009 per unit of length.
    hold("paint: pieces side by side", pairs.flat_map(|(a, b)| (0..3).map(move |c| (a[c] - b[c]).abs())).worst(), 2e-4);
}

fn what_cannot_be_painted_is_told(gpu: &Gpu) {
    let painter = Painter::new(gpu).expect("builds");
    let progress = Progress::new(gpu.adapter());
    let told = |material: &Material, recipe: &Recipe, method: PaintMethod| {
        painter.paint(material, recipe, method, &progress).expect_err("cannot be painted").to_string()
    };
    let (bare, good) = (bumps(gpu), of(&[layer("oil/viridian", 1.0, 0.0, SPLASH)]));
    let mut thin = good.clone();
    thin.layers[0].thickness = f64::NAN;
    assert!(told(&bare, &thin, PaintMethod::KubelkaMunk).contains("thickness of the layer of \"oil/viridian\" is NaN"));
    let image = of(&[layer("oil/viridian", 1.0, 0.0, Pattern::Image { image: 2 })]);
    assert_eq!(
        told(&bare, &image, PaintMethod::KubelkaMunk),
        "a layer draws image 2, but the recipe has 0; add it to the recipe's images, or name another"
    );
    // Past a binding of 16 bytes a texel, too, which is asked before the host holds as much.
    let wide = usize::try_from(gpu.max_array_bytes()).expect("fits") / 16 / (48 * 32) + 1;
    for repeat in [[0, 1], [wide, 1], [1 << 20, 1 << 20], [usize::MAX, 2]] {
        let far = Recipe { repeat, ..good.clone() };
        assert!(told(&bare, &far, PaintMethod::KubelkaMunk).contains("repeat the material less often"));
    }
    let painted = painted(gpu, &bare, &good, PaintMethod::AlphaBlend);
    assert_eq!(
        told(&painted, &good, PaintMethod::KubelkaMunk),
        "the material is already painted by alpha blending, which cannot go on by Kubelka-Munk; paint the bare material"
    );
}

/// Each swatch over black and over white is the film of its thickness there.
fn swatches_are_films_over_their_grounds(gpu: &Gpu) {
    let paints: Vec<_> = pigments::all().map(Paint::from).collect();
    let sheet = swatches(gpu, &paints, &Progress::new(gpu.adapter())).expect("fits");
    // The first pixel of the first swatch: below the line of thicknesses, right of the longest name.
    let longest = paints.iter().map(|paint| paint.name.len()).max().expect("there are some");
    let [left, top] = [12 + 8 * longest + 12, 12 + 8 + 6];
    for (row, paint) in paints.iter().enumerate() {
        for (column, thickness) in [0.1, 0.25, 0.5, 1.0, 2.0, 5.0, 10.0].into_iter().enumerate() {
            for (band, ground) in [(0, 0.03), (1, 0.9)] {
                let found = sheet[(left + column * (84 + 6) + band * 28 + 14, top + row * (48 + 6) + 24)];
                let expected = paint.films(thickness).map(|film| film.over_substrate(ground));
                let errors = (0..3).map(|channel| (f64::from(found[channel]) - expected[channel]).abs());
                // A handful of roundings of values below 1, as in the parity of films.
                hold("swatches: films over black and white", errors.worst(), 1e-6);
            }
        }
    }
}

const SMALL: FigureSettings = FigureSettings { side: 64, rays: 1, texels: 64 };

fn figures_are_made_of_every_material(gpu: &Gpu) {
    let pictured = |name: &str, material| Pictured { name: name.to_owned(), material, source: None };
    let folder = tempfile::tempdir().expect("is made");
    let coated = painted(gpu, &bumps(gpu), &of(&[layer("oil/viridian", 1.0, 0.0, SPLASH)]), PaintMethod::KubelkaMunk);
    let refused = figures(gpu, &[pictured("coated", coated)], Vec::new(), SMALL, folder.path(), &Progress::new(gpu.adapter())).expect_err("is painted");
    assert!(refused.to_string().starts_with("the material is painted"), "{refused}");

    let recipe = Synth { height_field: HeightField::Flat, relief: 0.0, reflectance: SynthReflectance::Matte, seed: 4 };
    let zenith = vec![Direction::from_degrees(0.0, 0.0)];
    let made = Synthetic::new(gpu, "flat", recipe, [64, 64], zenith.clone(), zenith, &Progress::new(gpu.adapter()));
    let flat = made.expect("is made").truth();
    figures(gpu, &[pictured("flat", flat)], Vec::new(), SMALL, folder.path(), &Progress::new(gpu.adapter())).expect("are made");
    let html = std::fs::read_to_string(folder.path().join(FIGURES)).expect("is there");
    let named: Vec<_> = html.split("src=\"").skip(1).filter_map(|rest| rest.split('"').next()).collect();
    // Three paints bare and at two thicknesses, twice; two methods at four thicknesses, twice. On models: bare and painted from two sides,
    // twice; three paints of three indices, four times; two models at three thicknesses, twice; four layers, twice.
    assert_eq!(named.len(), 2 * 9 + 2 * 8 + 2 * 4 + 4 * 9 + 2 * 6 + 2 * 4, "{named:?}");
    for file in named {
        assert!(image::open(folder.path().join(file)).expect("is a picture").width() >= 64, "{file}");
    }
    for number in ["4.3", "4.4", "4.5", "4.6", "4.7", "4.8", "4.9", "4.10", "4.11", "4.12", "4.13", "4.14", "4.15", "4.16"] {
        assert!(html.contains(&format!("(thesis fig. {number}): flat")), "{number}");
    }
}
