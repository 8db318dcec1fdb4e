//! Every WGSL file is embedded, links, validates and keeps to the house's form.

use std::{collections::BTreeSet, path::Path};

use overpaint::{
    gpu::{Access, LinkError, Source, reflect},
    wgsl,
};

crate::suite! { plain: every_file_is_embedded, every_file_links_and_validates, a_circle_is_named, an_unknown_import_is_named, a_file_is_joined_once; }

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

fn every_file_links_and_validates() {
    for source in wgsl::ALL {
        let text = source.link(wgsl::ALL).unwrap_or_else(|error| panic!("{error}"));
        let reflection = reflect(source.name, &text).unwrap_or_else(|error| panic!("{error}"));
        let (uniforms, storage): (Vec<_>, Vec<_>) =
            reflection.resources.iter().partition(|(_, resource)| resource.access == Access::Uniform);
        assert!(storage.len() <= 8, "{}: more than WebGPU's eight storage buffers", source.name);
        assert!(uniforms.len() <= 12, "{}: more than WebGPU's twelve uniforms", source.name);
        if let Some(size) = reflection.workgroup_size {
            assert!(size.iter().product::<u32>() <= 256, "{}: more than 256 invocations", source.name);
        }
    }
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
