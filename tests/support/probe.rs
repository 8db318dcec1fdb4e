//! Runs functions of `kernels/common` by themselves.

use overpaint::{
    gpu::{Bind, Gpu, Grid, Kernel, Resource, Source, bind},
    wgsl,
};

/// A kernel around `$function`: WGSL of `fn probe(index: u32) -> vec4<f32>`, which reads `inputs: array<vec4<f32>>`.
#[macro_export]
macro_rules! probe {
    ($import:literal, $function:literal) => {
        concat!(
            "#import thread\n#import ",
            $import,
            "\n@group(0) @binding(0) var<storage, read> inputs: array<vec4<f32>>;
            @group(0) @binding(1) var<storage, read_write> outputs: array<vec4<f32>>;\n",
            $function,
            "\n@compute @workgroup_size(64)
            fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>, @builtin(local_invocation_index) local: u32) {
                let index = thread_index(group, groups, local, 64u);
                if index < arrayLength(&outputs) {
                    outputs[index] = probe(index);
                }
            }"
        )
    };
}

/// The first `count` values of the probe in `text` over `inputs`.
pub fn probe(gpu: &Gpu, text: &'static str, inputs: &[[f32; 4]], count: usize) -> Vec<[f32; 4]> {
    probe_with(gpu, text, inputs, count, &[], &[])
}

/// As [`probe`], of a function that reads more than its inputs.
pub fn probe_with(
    gpu: &Gpu, text: &'static str, inputs: &[[f32; 4]], count: usize, resources: &[Resource], binds: &[Bind<'_>],
) -> Vec<[f32; 4]> {
    let source = Source { name: "probe", path: "tests", text };
    let own = [Resource::read::<[f32; 4]>("inputs"), Resource::read_write::<[f32; 4]>("outputs")];
    let kernel = Kernel::new(gpu, &source, wgsl::ALL, &[&own, resources].concat()).expect("builds");
    let inputs = gpu.upload("inputs", inputs).expect("fits");
    let outputs = gpu.fresh("outputs", count).expect("fits");
    let mut recorder = gpu.recorder();
    let binds = [&[bind("inputs", &inputs), bind("outputs", &outputs)], binds].concat();
    recorder.dispatch(&kernel, &binds, Grid::threads(count)).expect("records");
    gpu.submit(recorder).wait(gpu).expect("runs");
    outputs.read(gpu).expect("reads")
}
