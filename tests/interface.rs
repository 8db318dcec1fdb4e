//! The host's declaration of what a shader binds is held to the WGSL.

use overpaint::{
    gpu::{Gpu, GpuError, Kernel, Resource, Source},
    gpu_struct,
};

crate::suite! { gpu: equal_sides_agree, each_kind_of_difference_is_named; }

gpu_struct! {
    struct Params { width: u32, height: u32, scale: f32, _pad: u32 }
}

const SOURCE: Source = Source {
    name: "test",
    path: "test",
    text: "
        struct Params { width: u32, height: u32, scale: f32, _pad: u32 }
        @group(0) @binding(0) var<uniform> params: Params;
        @group(0) @binding(1) var<storage, read> source: array<vec4<f32>>;
        @group(0) @binding(2) var<storage, read_write> result: array<f32>;
        @compute @workgroup_size(64) fn main() { result[0] = source[0].x * params.scale; }",
};

fn host() -> Vec<Resource> {
    vec![Resource::uniform::<Params>("params"), Resource::read::<[f32; 4]>("source"), Resource::read_write::<f32>("result")]
}

fn equal_sides_agree(gpu: &Gpu) {
    Kernel::new(gpu, &SOURCE, &[], &host()).expect("both sides agree");
}

fn each_kind_of_difference_is_named(gpu: &Gpu) {
    gpu_struct! { struct Swapped { height: u32, width: u32, scale: f32, _pad: u32 } }
    gpu_struct! { struct Retyped { width: u32, height: u32, scale: u32, _pad: u32 } }
    let replaced = |index: usize, resource| {
        let mut host = host();
        host[index] = resource;
        host
    };
    let more = [host(), vec![Resource::read::<f32>("extra")]].concat();
    for (host, expected) in [
        (replaced(0, Resource::uniform::<Swapped>("params")), "width: U32 x 1 at byte 0"),
        (replaced(0, Resource::uniform::<Retyped>("params")), "scale: F32 x 1 at byte 8"),
        (replaced(1, Resource::read::<f32>("source")), "16 bytes in the WGSL and 4"),
        (replaced(1, Resource::read::<[u32; 4]>("source")), "F32 x 4"),
        (replaced(2, Resource::read::<f32>("result")), "ReadWrite in the WGSL and Read"),
        (replaced(2, Resource::read_write::<f32>("output")), "\"result\", which the host does not declare"),
        (more, "\"extra\", which the WGSL does not bind"),
    ] {
        let error = Kernel::new(gpu, &SOURCE, &[], &host).expect_err("they differ");
        assert!(matches!(error, GpuError::Interface { .. }), "{error:?}");
        assert!(error.to_string().contains(expected), "{error}");
    }
}
