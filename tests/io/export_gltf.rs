//! A mesh that wears a material as glTF.

use std::path::Path;

use gltf::{Gltf, image::Source};
use image::{DynamicImage, ImageFormat};
use overpaint::{
    data::{Lobe, Map, Material, Mesh, Painted, Shape},
    io::{
        self,
        export::{GltfFormat, write_gltf},
    },
    model::{Frame, PaintMethod, color::srgb_from_linear},
};
use serde_json::Value;

use super::assert_says;
use crate::support::{
    hold,
    material::{local_pca, painted, sample},
    worst_difference,
};

crate::suite! { plain:
    texels_have_the_codes_of_their_reflectance,
    the_specular_factor_reaches_the_largest,
    the_document_is_valid_and_says_what_is_lost,
    meshes_come_back,
    tiling_is_in_the_texture_coordinates,
    what_is_lost_depends_on_what_was_there,
    what_has_no_code_is_refused;
}

/// A bare material of 3 x 2 texels: diffuse (0.5, 0.25, 0) and no lobes; its normals point up but for (0, 0), (1, 0) and (0, 1).
fn bare() -> Material {
    let size = [3, 2];
    let material = sample(size, 1);
    let mut normal = Map::from_fn(3, 2, |_, _| [0.0, 0.0, 1.0]);
    normal[(0, 0)] = [0.6, 0.0, 0.8];
    normal[(1, 0)] = [0.0, 0.6, 0.8];
    normal[(0, 1)] = [-1.0, 0.0, 0.0];
    let mut svbrdf = material.svbrdf;
    svbrdf.frame = Frame::Texel;
    svbrdf.ambient = 0.0;
    svbrdf.diffuse = Map::from_fn(3, 2, |_, _| [0.5, 0.25, 0.0]);
    svbrdf.lobes =
        vec![Lobe { specular: Map::from_fn(3, 2, |_, _| [0.0; 3]), parameters: Map::from_fn(3, 2, |_, _| [-1.0, -1.0, 1.0, 12.0]) }];
    Material { normal, svbrdf, ..sample(size, 1) }
}

/// It, painted: (0, 0) bare, (1, 0) in full, (2, 0) in half.
fn half_painted() -> Material {
    let mut paint = painted([3, 2], 1);
    paint.reflectance = Map::from_fn(3, 2, |_, _| [0.2, 0.4, 0.6]);
    paint.coverage = Map::from_fn(3, 2, |x, y| if y == 0 { [0.0, 1.0, 0.5][x] } else { 0.0 });
    paint.coat = Map::from_fn(3, 2, |_, _| [0.04, 0.25]);
    paint.normal = Map::from_fn(3, 2, |_, _| [0.0, -0.6, 0.8]);
    Material { painted: Some(paint), ..bare() }
}

fn exported(material: &Material, mesh: &Mesh) -> (Gltf, Vec<String>) {
    let folder = tempfile::tempdir().expect("is made");
    let path = folder.path().join("a.glb");
    let lost = write_gltf(&path, GltfFormat::Binary, material, mesh, 1.0).expect("writes");
    (Gltf::from_slice(&std::fs::read(&path).expect("is there")).expect("is valid"), lost)
}

/// The images, decoded: base colour, normal, metallic roughness, specular.
fn images(gltf: &Gltf) -> [DynamicImage; 4] {
    let blob = gltf.blob.as_ref().expect("is binary");
    let decoded = |texture: gltf::Texture<'_>| {
        let Source::View { view, mime_type } = texture.source().source() else { panic!("the image is elsewhere") };
        assert_eq!(mime_type, "image/png");
        let bytes = &blob[view.offset()..view.offset() + view.length()];
        image::load_from_memory_with_format(bytes, ImageFormat::Png).expect("is a PNG")
    };
    let material = gltf.materials().next().expect("has one");
    let (pbr, specular) = (material.pbr_metallic_roughness(), material.specular().expect("has it"));
    let texture = specular.specular_texture().expect("has one").texture();
    assert_eq!(specular.specular_color_texture().expect("has one").texture().index(), texture.index());
    [
        decoded(pbr.base_color_texture().expect("has one").texture()),
        decoded(material.normal_texture().expect("has one").texture()),
        decoded(pbr.metallic_roughness_texture().expect("has one").texture()),
        decoded(texture),
    ]
}

fn srgb(value: f64) -> u8 {
    (255.0 * srgb_from_linear(value)).round() as u8
}

fn texels_have_the_codes_of_their_reflectance() {
    let (gltf, lost) = exported(&bare(), &Shape::Plane.mesh());
    let [base_color, normal, roughness, specular] = images(&gltf);
    let (base_color, normal, roughness, specular) = (base_color.into_rgb8(), normal.into_rgb8(), roughness.into_rgb8(), specular.into_rgba8());
    assert_eq!(base_color.dimensions(), (3, 2));
    assert!(base_color.pixels().all(|pixel| pixel.0 == [188, 137, 0]), "{base_color:?}");
    // (1 + x)/2 of 255, row 0 at the top; z is never below 0.
    assert_eq!([(0, 0), (1, 0), (0, 1), (2, 1)].map(|(x, y)| normal.get_pixel(x, y).0), [
        [204, 128, 230],
        [128, 204, 230],
        [0, 128, 128],
        [128, 128, 255]
    ]);
    // Nothing shines: rough, and F90 = 0.
    assert!(roughness.pixels().all(|pixel| pixel.0 == [0, 255, 0]));
    assert!(specular.pixels().all(|pixel| pixel.0[3] == 0));
    assert!(lost.iter().all(|lost| !lost.contains("above 1")), "{lost:?}");

    let (gltf, _) = exported(&half_painted(), &Shape::Plane.mesh());
    let [base_color, normal, roughness, specular] = images(&gltf);
    let (base_color, normal, roughness, specular) = (base_color.into_rgb8(), normal.into_rgb8(), roughness.into_rgb8(), specular.into_rgba8());
    // Of a coat of F0 = 0.04 light from everywhere has 0.04 + 0.96/21 reflected. Half of the texel has one.
    let kept = 0.04 + 0.96 / 21.0;
    let half = [(0.5, 0.2), (0.25, 0.4), (0.0, 0.6)].map(|(bare, paint)| srgb(0.5 * (bare + (1.0 - kept) * paint) / (1.0 - 0.5 * kept)));
    let of = [0, 1, 2].map(|x| base_color.get_pixel(x, 0).0);
    assert_eq!(of, [[188, 137, 0], [0.2, 0.4, 0.6].map(srgb), half]);
    // The painted surface's normals, everywhere.
    assert!(normal.pixels().all(|pixel| pixel.0 == [128, 51, 230]));
    // √0.25; where there is no surface, rough.
    assert_eq!([0, 1, 2].map(|x| roughness.get_pixel(x, 0).0[1]), [255, 128, 128]);
    assert_eq!([0, 1, 2].map(|x| specular.get_pixel(x, 0).0), [[255, 255, 255, 0], [255; 4], [255, 255, 255, 128]]);
}

fn the_specular_factor_reaches_the_largest() {
    let mut material = half_painted();
    let paint = material.painted.as_mut().expect("is painted");
    paint.coverage = Map::from_fn(3, 2, |_, _| 1.0);
    // Refractive indices of 1.5, 2 and 1.2.
    paint.coat = Map::from_fn(3, 2, |x, _| [[0.04, 1.0 / 9.0, 0.01 / 1.21][x], 0.0121]);
    let (gltf, _) = exported(&material, &Shape::Plane.mesh());
    let factor = gltf.materials().next().and_then(|material| material.specular()).expect("has it").specular_color_factor();
    hold("export: specular color factor", worst_difference(factor.map(f64::from), [1.0 / 9.0 / 0.04; 3]), 1e-6);
    let codes = images(&gltf)[3].to_rgba8();
    let f0 = [0, 1, 2].map(|x| codes.get_pixel(x, 0).0);
    let expected = [0.04 * 9.0, 1.0, 0.09 / 1.21].map(srgb).map(|code| [code, code, code, 255]);
    assert_eq!(f0, expected);
    // √0.0121 of 255 is 28.05.
    assert_eq!(images(&gltf)[2].to_rgb8().get_pixel(0, 0).0, [0, 28, 0]);
}

fn the_document_is_valid_and_says_what_is_lost() {
    let (gltf, lost) = exported(&half_painted(), &Shape::Cloth.mesh());
    let material = gltf.materials().next().expect("has one");
    assert_eq!((material.pbr_metallic_roughness().metallic_factor(), material.pbr_metallic_roughness().roughness_factor()), (0.0, 1.0));
    assert_eq!((material.name(), material.double_sided()), (Some("a \"sample\", θ"), true));
    assert!(gltf.extensions_used().eq(["KHR_materials_specular"]) && gltf.extensions_required().count() == 0);
    use gltf::texture::WrappingMode::Repeat;
    assert!(gltf.textures().all(|texture| (texture.sampler().wrap_s(), texture.sampler().wrap_t()) == (Repeat, Repeat)));
    assert_eq!((gltf.textures().count(), gltf.samplers().count(), gltf.buffers().count()), (4, 1, 1));
    let asset = &gltf.as_json().asset;
    assert_eq!(asset.generator.as_deref(), Some(concat!("overpaint ", env!("CARGO_PKG_VERSION"))));
    let extras: Value = serde_json::from_str(asset.extras.as_ref().expect("has them").get()).expect("is JSON");
    assert_eq!(extras["lost"], Value::from(lost));
    // Views do not overlap, start at multiples of 4 and are inside the buffer.
    let mut end = 0;
    for view in gltf.views() {
        assert!(view.offset() >= end && view.offset() % 4 == 0, "{view:?}");
        end = view.offset() + view.length();
    }
    assert_eq!(gltf.buffers().next().map(|buffer| buffer.length()), Some(end));
}

/// The values at each corner of each triangle.
fn corners(mesh: &Mesh) -> Vec<f64> {
    let values = |&vertex: &u32| {
        let vertex = vertex as usize;
        let place = mesh.positions()[vertex].into_iter().chain(mesh.normals()[vertex]);
        place.chain(mesh.tangents()[vertex]).chain(mesh.texture_coordinates()[vertex])
    };
    mesh.triangles().iter().flatten().flat_map(values).map(f64::from).collect()
}

fn meshes_come_back() {
    let folder = tempfile::tempdir().expect("is made");
    for shape in Shape::ALL {
        let mesh = shape.mesh();
        for (name, format) in [("a.glb", GltfFormat::Binary), ("a.gltf", GltfFormat::Json)] {
            let path = folder.path().join(name);
            assert_eq!(GltfFormat::of(&path), Some(format));
            write_gltf(&path, format, &half_painted(), &mesh, 1.0).expect("writes");
            let loaded = io::mesh::load(&path).expect("is a mesh");
            assert_eq!(loaded.warnings, [""; 0]);
            // Texture coordinates up to 10 are taken from 1 twice, and frames are made unit once more.
            hold("export: a mesh there and back", worst_difference(corners(&loaded.mesh), corners(&mesh)), 1e-6);
        }
    }
    assert_eq!(std::fs::read_dir(folder.path()).expect("is there").count(), 2, "each is one file");
}

fn tiling_is_in_the_texture_coordinates() {
    let folder = tempfile::tempdir().expect("is made");
    let path = folder.path().join("a.glb");
    let mesh = Shape::Plane.mesh();
    write_gltf(&path, GltfFormat::Binary, &bare(), &mesh, 2.5).expect("writes");
    let loaded = io::mesh::load(&path).expect("is a mesh").mesh;
    let expected: Vec<_> = mesh.texture_coordinates().iter().map(|uv| uv.map(|x| 2.5 * x)).collect();
    let mut found = loaded.texture_coordinates().to_vec();
    // The vertices are numbered by the first triangle that has them: the square's last two change places.
    found.swap(2, 3);
    assert_eq!(found, expected);
    // Seen upright, v = 1 is the image's top: 0 in glTF.
    let gltf = Gltf::open(&path).expect("is valid");
    let primitive = gltf.meshes().next().and_then(|mesh| mesh.primitives().next()).expect("has one");
    let blob = gltf.blob.as_deref();
    let reader = primitive.reader(|_| blob);
    let texture: Vec<_> = reader.read_tex_coords(0).expect("has them").into_f32().collect();
    assert_eq!(texture[0], [0.0, 1.0]);
    assert_eq!(texture[3], [2.5, -1.5]);
}

fn what_is_lost_depends_on_what_was_there() {
    let told = |material: &Material| exported(material, &Shape::Plane.mesh()).1.join("\n");
    let text = told(&bare());
    for part in ["no parallax", "(100.0 % of texels)", "a Lafortune lobe\n", "normals to 0.4 degrees", "KHR_materials_specular"] {
        assert!(text.contains(part), "\"{part}\" in {text}");
    }
    for part in ["local PCA", "above 1", "shadows,", "fitted with", "blended", "sent back"] {
        assert!(!text.contains(part), "\"{part}\" in {text}");
    }
    let mut material = Material { lpca: Some(local_pca([3, 2], [6, 3, 2])), ..bare() };
    material.svbrdf.frame = Frame::Plane;
    material.svbrdf.ambient = 0.25;
    material.svbrdf.diffuse[(1, 1)] = [0.0, 1.5, 0.0];
    let lobe = Lobe { specular: Map::from_fn(3, 2, |_, _| [0.1; 3]), parameters: Map::from_fn(3, 2, |_, _| [0.5, 0.5, 1.0, 3.0]) };
    material.svbrdf.lobes.push(lobe.clone());
    let mut paint = painted([3, 2], 1);
    paint.method = PaintMethod::AlphaBlend;
    paint.coverage = Map::from_fn(3, 2, |_, y| if y == 0 { 1.0 } else { 0.0 });
    material.painted = Some(Painted { reflectance: Map::from_fn(3, 2, |_, _| [0.3; 3]), ..paint });
    let text = told(&material);
    for part in [
        "(50.0 % of texels)",
        "2 Lafortune lobes and the local PCA of the original; in 100.0 % of them light was sent back",
        "that of a plane",
        "own shadows, 25.0 %",
        "blended in",
        // One texel of six.
        "16.7 % of texels have a base color above 1, held to 1",
    ] {
        assert!(text.contains(part), "\"{part}\" in {text}");
    }
    // Painted all over, what was bare is no loss.
    let mut material = half_painted();
    material.painted.as_mut().expect("is painted").coverage = Map::from_fn(3, 2, |_, _| 1.0);
    assert!(!told(&material).contains("the bare part"));
    // A mirror of more than there is.
    let mut material = bare();
    material.svbrdf.lobes[0] = Lobe { specular: Map::from_fn(3, 2, |x, _| [[0.0, 50.0, 0.0][x]; 3]), ..lobe };
    assert!(told(&material).contains("33.3 % of texels have a reflectance at normal incidence above 1, held to 1"));
}

fn what_has_no_code_is_refused() {
    let folder = tempfile::tempdir().expect("is made");
    let path = folder.path().join("a.glb");
    let write = |material: &Material, path: &Path| write_gltf(path, GltfFormat::Binary, material, &Shape::Plane.mesh(), 1.0);
    let mut material = half_painted();
    material.svbrdf.lobes[0].parameters[(1, 1)] = [f32::NAN; 4];
    material.svbrdf.lobes[0].specular[(1, 1)] = [0.1; 3];
    assert_says(write(&material, &path), &["a.glb", "column 1, row 1", "not a number"]);
    let mut material = half_painted();
    material.painted.as_mut().expect("is painted").normal[(2, 1)] = [f32::INFINITY, 0.0, 0.0];
    assert_says(write(&material, &path), &["column 2, row 1"]);
    assert!(!path.exists());
    assert_says(write(&bare(), &folder.path().join("no/such/a.glb")), &["cannot write", "a.glb"]);
    for name in ["a.obj", "gltf", "a"] {
        assert_eq!(GltfFormat::of(Path::new(name)), None);
    }
    assert_eq!(GltfFormat::of(Path::new("A.GLB")), Some(GltfFormat::Binary));
}
