//! Compute kernels: built from a source, checked against their host's declaration, dispatched by the recorder.

use std::{
    collections::HashMap,
    hash::Hash,
    num::NonZeroU64,
    sync::{Mutex, PoisonError},
};

use pollster::block_on;

use super::{Access, Buffer, DepthLayers, Gpu, GpuError, GpuValue, Layers, Resource, Source, Target, interface, reflect};

/// A buffer or texture bound to a name for one dispatch.
#[derive(Debug, Clone, Copy)]
pub struct Bind<'a> {
    name: &'a str,
    bound: Bound<'a>,
}

#[derive(Debug, Clone, Copy)]
enum Bound<'a> {
    /// And the bytes of an element.
    Buffer(&'a wgpu::Buffer, usize),
    Texture(&'a wgpu::TextureView, Access),
}

/// Binds `buffer` to the WGSL variable `name`.
#[must_use]
pub fn bind<'a, T: GpuValue>(name: &'a str, buffer: &'a Buffer<T>) -> Bind<'a> {
    Bind { name, bound: Bound::Buffer(&buffer.raw, size_of::<T>()) }
}

/// Binds `layers` to the WGSL variable `name`.
#[must_use]
pub fn bind_layers<'a>(name: &'a str, layers: &'a Layers) -> Bind<'a> {
    Bind { name, bound: Bound::Texture(&layers.view, Access::Layers) }
}

/// Binds `depths` to the WGSL variable `name`.
#[must_use]
pub fn bind_depth_layers<'a>(name: &'a str, depths: &'a DepthLayers) -> Bind<'a> {
    Bind { name, bound: Bound::Texture(&depths.view, Access::DepthLayers) }
}

/// Binds what was drawn into `target` to the WGSL variable `name`.
#[must_use]
pub fn bind_target<'a>(name: &'a str, target: &'a Target) -> Bind<'a> {
    Bind { name, bound: Bound::Texture(&target.layers, Access::Layers) }
}

/// How many threads a dispatch needs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Grid {
    /// Threads along the first axis, rounded up to whole workgroups. Folded over x and y of the dispatch where there are more
    /// workgroups than one dimension holds; kernels recover the index with `thread_index`.
    pub threads: usize,
    /// Layers, in z of the dispatch.
    pub layers: u32,
}

impl Grid {
    /// One layer of `threads`.
    #[must_use]
    pub fn threads(threads: usize) -> Self {
        Self { threads, layers: 1 }
    }

    /// `layers` layers of `threads`.
    #[must_use]
    pub fn layers(threads: usize, layers: u32) -> Self {
        Self { threads, layers }
    }
}

/// The passes of one kind that a device has built, by all that makes them what they are: their linked text and more. Stages are built where
/// they are used, and so again and again; a driver takes a tenth of a second and more for each.
#[derive(Debug)]
pub(super) struct Built<K, T>(Mutex<HashMap<K, T>>);

impl<K, T> Default for Built<K, T> {
    fn default() -> Self {
        Self(Mutex::default())
    }
}

impl<K: Eq + Hash, T: Clone> Built<K, T> {
    /// The pass of this key; `build` makes it if there is none yet.
    pub(super) fn get_or_build(&self, key: K, build: impl FnOnce(&K) -> Result<T, GpuError>) -> Result<T, GpuError> {
        let built = || self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(pass) = built().get(&key) {
            return Ok(pass.clone());
        }
        // Another thread may build the same meanwhile: either serves.
        let pass = build(&key)?;
        built().insert(key, pass.clone());
        Ok(pass)
    }
}

/// The layout and names shared by compute kernels and render passes.
#[derive(Debug, Clone)]
pub(super) struct Bindings {
    pub(super) name: &'static str,
    pub(super) layout: wgpu::BindGroupLayout,
    resources: Vec<(u32, Resource)>,
}

/// Reads the shader's interface, and builds module and layouts.
pub(super) fn build(
    gpu: &Gpu, source: &Source, text: &str,
) -> Result<(Bindings, interface::Reflection, wgpu::ShaderModule, wgpu::PipelineLayout), GpuError> {
    let reflection = reflect(source.name, text)?;
    let entries: Vec<_> = reflection
        .resources
        .iter()
        .zip(&reflection.visibility)
        .map(|((binding, resource), visibility)| wgpu::BindGroupLayoutEntry {
            binding: *binding,
            visibility: *visibility,
            ty: binding_type(resource),
            count: None,
        })
        .collect();
    let layout = gpu.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label: Some(source.name), entries: &entries });
    let pipeline_layout = gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: Some(source.name),
        bind_group_layouts: &[Some(&layout)],
        immediate_size: 0,
    });
    let module = gpu
        .device
        .create_shader_module(wgpu::ShaderModuleDescriptor { label: Some(source.name), source: wgpu::ShaderSource::Wgsl(text.into()) });
    let bindings = Bindings { name: source.name, layout, resources: reflection.resources.clone() };
    Ok((bindings, reflection, module, pipeline_layout))
}

fn binding_type(resource: &Resource) -> wgpu::BindingType {
    let buffer =
        |ty| wgpu::BindingType::Buffer { ty, has_dynamic_offset: false, min_binding_size: NonZeroU64::new(resource.stride as u64) };
    let texture =
        |sample_type| wgpu::BindingType::Texture { sample_type, view_dimension: wgpu::TextureViewDimension::D2Array, multisampled: false };
    match resource.access {
        Access::Uniform => buffer(wgpu::BufferBindingType::Uniform),
        Access::Read => buffer(wgpu::BufferBindingType::Storage { read_only: true }),
        Access::ReadWrite => buffer(wgpu::BufferBindingType::Storage { read_only: false }),
        Access::Layers => texture(wgpu::TextureSampleType::Float { filterable: false }),
        Access::DepthLayers => texture(wgpu::TextureSampleType::Depth),
    }
}

impl Bindings {
    /// Checks the host's side against the shader's.
    pub(super) fn check(&self, host: &[Resource]) -> Result<(), GpuError> {
        interface::compare(self.name, &self.resources, host)
    }

    /// # Panics
    /// If a name is missing, unknown, or bound to another kind of thing or to elements of another size: the host's bug.
    pub(super) fn group(&self, gpu: &Gpu, binds: &[Bind<'_>]) -> wgpu::BindGroup {
        let name = self.name;
        for bind in binds {
            assert!(self.resources.iter().any(|(_, resource)| resource.name == bind.name), "{name}: nothing is called \"{}\"", bind.name);
        }
        let entries: Vec<_> = self
            .resources
            .iter()
            .map(|(binding, resource)| {
                let Some(bind) = binds.iter().find(|bind| bind.name == resource.name) else {
                    panic!("{name}: \"{}\" is not bound", resource.name)
                };
                let resource = match bind.bound {
                    Bound::Buffer(raw, stride) => {
                        assert_eq!(stride, resource.stride, "{name}: bytes of an element of \"{}\"", resource.name);
                        raw.as_entire_binding()
                    }
                    Bound::Texture(view, access) => {
                        assert_eq!(access, resource.access, "{name}: kind of \"{}\"", resource.name);
                        wgpu::BindingResource::TextureView(view)
                    }
                };
                wgpu::BindGroupEntry { binding: *binding, resource }
            })
            .collect();
        gpu.device.create_bind_group(&wgpu::BindGroupDescriptor { label: Some(name), layout: &self.layout, entries: &entries })
    }
}

/// A compute kernel, ready to be dispatched.
#[derive(Debug, Clone)]
pub struct Kernel {
    pub(super) bindings: Bindings,
    pub(super) pipeline: wgpu::ComputePipeline,
    workgroup_threads: u32,
    max_groups: u32,
}

impl Kernel {
    /// Builds `source`, joined with what it imports from `library`, after checking `resources` against it.
    ///
    /// # Errors
    /// [`GpuError::Link`], [`GpuError::Shader`] or [`GpuError::Interface`].
    pub fn new(gpu: &Gpu, source: &Source, library: &[Source], resources: &[Resource]) -> Result<Self, GpuError> {
        let kernel = gpu.kernels.get_or_build(source.link(library)?, |text| Self::build(gpu, source, text))?;
        kernel.bindings.check(resources)?;
        Ok(kernel)
    }

    fn build(gpu: &Gpu, source: &Source, text: &str) -> Result<Self, GpuError> {
        let scope = gpu.device.push_error_scope(wgpu::ErrorFilter::Validation);
        let (bindings, reflection, module, layout) = build(gpu, source, text)?;
        let pipeline = gpu.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some(source.name),
            layout: Some(&layout),
            module: &module,
            entry_point: Some("main"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            cache: None,
        });
        if let Some(error) = block_on(scope.pop()) {
            return Err(GpuError::Shader { name: source.name.to_owned(), message: error.to_string() });
        }
        let workgroup_threads = reflection.workgroup_size.map_or(1, |size| size.iter().product());
        Ok(Self { bindings, pipeline, workgroup_threads, max_groups: gpu.device.limits().max_compute_workgroups_per_dimension })
    }

    /// Stem of the kernel's file, by which its passes are timed.
    #[must_use]
    pub fn name(&self) -> &'static str {
        self.bindings.name
    }

    /// Workgroups along x, y and z for a grid.
    pub(super) fn groups(&self, grid: Grid) -> Result<[u32; 3], GpuError> {
        let groups = (grid.threads as u64).div_ceil(u64::from(self.workgroup_threads)).max(1);
        let limit = u64::from(self.max_groups);
        let rows = groups.div_ceil(limit);
        if rows > limit || u64::from(grid.layers) > limit {
            return Err(GpuError::GridTooLarge { kernel: self.name(), groups, limit: limit * limit });
        }
        // Even rows: no more than rows-1 workgroups are left without work.
        let columns = groups.div_ceil(rows);
        let to_u32 = |count: u64| u32::try_from(count).unwrap_or(u32::MAX);
        Ok([to_u32(columns), to_u32(rows), grid.layers])
    }
}
