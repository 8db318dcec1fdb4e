//! Every WGSL file is embedded, links, validates and keeps to the house's form.

use std::{collections::BTreeSet, path::Path};

use overpaint::{
    gpu::{Access, LinkError, Source, reflect},
    wgsl,
};
use wgpu::ShaderStages;

crate::suite! { plain: every_file_is_embedded, every_pass_links_and_validates, every_common_file_serves_a_pass, a_circle_is_named, an_unknown_import_is_named, a_file_is_joined_once; }

fn every_file_is_embedded() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut files = BTreeSet::new();
    for folder in ["kernels", "kernels/common", "shaders"] {
        for entry in std::fs::read_dir(root.join(folder)).expect("is there") {
            let name = entry.expect("is readable").file_name().into_string().expect("is ASCII");
            if name.ends_with(".wgsl") {
                files.insert(format!("{folder}/{name}"));
            }
        }
    }
    let embedded: BTreeSet<_> = wgsl::ALL.iter().map(|source| source.path.to_owned()).collect();
    assert_eq!(files, embedded);
}

/// Passes: what several share is validated as part of each that imports it, with what the pass itself gives it.
fn passes() -> impl Iterator<Item = &'static Source> {
    wgsl::ALL.iter().filter(|source| !source.path.starts_with("kernels/common/"))
}

fn every_pass_links_and_validates() {
    for source in passes() {
        let text = source.link(wgsl::ALL).unwrap_or_else(|error| panic!("{error}"));
        let reflection = reflect(source.name, &text).unwrap_or_else(|error| panic!("{error}"));
        for stage in [ShaderStages::COMPUTE, ShaderStages::VERTEX, ShaderStages::FRAGMENT] {
            let reached = reflection.resources.iter().zip(&reflection.visibility).filter(|(_, visibility)| visibility.contains(stage));
            let accesses: Vec<_> = reached.map(|((_, resource), _)| resource.access).collect();
            let count = |of: &[Access]| accesses.iter().filter(|access| of.contains(access)).count();
            let (uniforms, storage) = (count(&[Access::Uniform]), count(&[Access::Read, Access::ReadWrite]));
            let textures = count(&[Access::Layers, Access::DepthLayers]);
            assert!(textures <= 16, "{}: more than WebGPU's sixteen textures a stage", source.name);
            assert!(storage <= 8, "{}: more than WebGPU's eight storage buffers a stage", source.name);
            assert!(uniforms <= 12, "{}: more than WebGPU's twelve uniforms a stage", source.name);
        }
        if let Some(size) = reflection.workgroup_size {
            assert!(size.iter().product::<u32>() <= 256, "{}: more than 256 invocations", source.name);
        }
    }
}

fn every_common_file_serves_a_pass() {
    let mut served: BTreeSet<_> = passes().flat_map(Source::imports).collect();
    loop {
        let further: BTreeSet<_> = wgsl::ALL.iter().filter(|source| served.contains(source.name)).flat_map(Source::imports).collect();
        let before = served.len();
        served.extend(further);
        if served.len() == before {
            break;
        }
    }
    let idle: Vec<_> =
        wgsl::ALL.iter().filter(|source| source.path.starts_with("kernels/common/") && !served.contains(source.name)).collect();
    assert!(idle.is_empty(), "no pass imports {idle:?}");
}

fn source(name: &'static str, text: &'static str) -> Source {
    Source { name, path: name, text }
}

fn a_circle_is_named() {
    let files = [source("a", "#import b\n"), source("b", "#import c\n"), source("c", "#import b\n")];
    assert_eq!(files[0].link(&files), Err(LinkError::Cycle { path: "b -> c -> b".to_owned() }));
}

fn an_unknown_import_is_named() {
    let files = [source("a", "#import nowhere\n")];
    assert_eq!(files[0].link(&files), Err(LinkError::UnknownImport { importer: "a".to_owned(), import: "nowhere".to_owned() }));
}

fn a_file_is_joined_once() {
    let files = [source("a", "#import b\n#import c\nA"), source("b", "#import d\nB"), source("c", "#import d\nC"), source("d", "D")];
    assert_eq!(files[0].link(&files).expect("links"), "D\nB\nC\nA\n");
}
