//! What a shader binds: declared by the host by name, read from the WGSL by reflection, and compared.
//!
//! Binding numbers exist in the WGSL alone.

use super::{Field, GpuError, GpuValue, layout};

/// How a shader reaches a buffer.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Access {
    /// `var<uniform>`: one parameter struct.
    Uniform,
    /// `var<storage, read>`: an array that is only read.
    Read,
    /// `var<storage, read_write>`: an array that is written.
    ReadWrite,
    /// `texture_2d_array<f32>`: pictures that are only read.
    Layers,
    /// `texture_depth_2d_array`: depths that are only read.
    DepthLayers,
}

/// One buffer or texture that a shader binds.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Resource {
    /// The variable's name in the WGSL.
    pub name: String,
    /// How it is reached.
    pub access: Access,
    /// Bytes of one element (of the struct itself for a uniform); 0 of a texture.
    pub stride: usize,
    /// The element's fields; none of a texture.
    pub fields: Vec<Field>,
}

impl Resource {
    fn of<T: GpuValue>(name: &str, access: Access) -> Self {
        Self { name: name.to_owned(), access, stride: size_of::<T>(), fields: T::fields() }
    }

    /// A `var<uniform>` of struct `T`.
    #[must_use]
    pub fn uniform<T: GpuValue>(name: &str) -> Self {
        Self::of::<T>(name, Access::Uniform)
    }

    /// A `var<storage, read>` array of `T`.
    #[must_use]
    pub fn read<T: GpuValue>(name: &str) -> Self {
        Self::of::<T>(name, Access::Read)
    }

    /// A `var<storage, read_write>` array of `T`.
    #[must_use]
    pub fn read_write<T: GpuValue>(name: &str) -> Self {
        Self::of::<T>(name, Access::ReadWrite)
    }

    /// A `texture_2d_array<f32>`.
    #[must_use]
    pub fn layers(name: &str) -> Self {
        Self { name: name.to_owned(), access: Access::Layers, stride: 0, fields: Vec::new() }
    }

    /// A `texture_depth_2d_array`.
    #[must_use]
    pub fn depth_layers(name: &str) -> Self {
        Self { name: name.to_owned(), access: Access::DepthLayers, stride: 0, fields: Vec::new() }
    }
}

/// A parsed and validated shader.
#[derive(Debug)]
pub struct Reflection {
    /// Its resources with their binding numbers, by number.
    pub resources: Vec<(u32, Resource)>,
    /// The stages that reach each of them: limits are counted stage by stage.
    pub visibility: Vec<wgpu::ShaderStages>,
    /// Invocations in a workgroup of its compute entry point, if it has one.
    pub workgroup_size: Option<[u32; 3]>,
}

/// Parses and validates linked WGSL and lists what it binds.
///
/// # Errors
/// [`GpuError::Shader`] with the validator's message, or if a resource is of a kind that this layer does not bind.
pub fn reflect(name: &str, text: &str) -> Result<Reflection, GpuError> {
    let invalid = |message: String| GpuError::Shader { name: name.to_owned(), message };
    let module = naga::front::wgsl::parse_str(text).map_err(|error| invalid(error.emit_to_string(text)))?;
    // Halves as words, by `unpack2x16float`, are in every WebGPU implementation.
    let mut validator =
        naga::valid::Validator::new(naga::valid::ValidationFlags::all(), naga::valid::Capabilities::SHADER_FLOAT16_IN_FLOAT32);
    let info = validator.validate(&module).map_err(|error| invalid(error.emit_to_string(text)))?;

    let mut resources = Vec::new();
    for (handle, global) in module.global_variables.iter() {
        let Some(binding) = &global.binding else { continue };
        let name = global.name.clone().unwrap_or_default();
        let access = match global.space {
            naga::AddressSpace::Uniform => Access::Uniform,
            naga::AddressSpace::Storage { access } if access.contains(naga::StorageAccess::STORE) => Access::ReadWrite,
            naga::AddressSpace::Storage { .. } => Access::Read,
            naga::AddressSpace::Handle => texture_access(&module.types[global.ty].inner)
                .ok_or_else(|| invalid(format!("\"{name}\" is neither texture_2d_array<f32> nor texture_depth_2d_array")))?,
            _ => return Err(invalid(format!("\"{name}\" is neither a uniform, a storage buffer nor a texture"))),
        };
        if binding.group != 0 {
            return Err(invalid(format!("\"{name}\" is in group {}; everything is bound in group 0", binding.group)));
        }
        let (element, stride) = match module.types[global.ty].inner {
            naga::TypeInner::Array { base, stride, .. } => (base, stride as usize),
            naga::TypeInner::Struct { span, .. } => (global.ty, span as usize),
            _ => (global.ty, 0),
        };
        let fields = match access {
            Access::Layers | Access::DepthLayers => Vec::new(),
            _ => layout::wgsl_fields(&module, element)
                .ok_or_else(|| invalid(format!("the elements of \"{name}\" are no 32-bit scalars, vectors or structs of them")))?,
        };
        let reached = module.entry_points.iter().enumerate().filter(|(entry, _)| !info.get_entry_point(*entry)[handle].is_empty());
        let visibility = reached.fold(wgpu::ShaderStages::NONE, |stages, (_, entry)| stages | stage_of(entry.stage));
        resources.push((binding.binding, Resource { name, access, stride, fields }, visibility));
    }
    resources.sort_by_key(|(binding, ..)| *binding);
    let (resources, visibility) = resources.into_iter().map(|(binding, resource, visibility)| ((binding, resource), visibility)).unzip();
    let workgroup_size =
        module.entry_points.iter().find(|entry| entry.stage == naga::ShaderStage::Compute).map(|entry| entry.workgroup_size);
    Ok(Reflection { resources, visibility, workgroup_size })
}

/// The kinds of texture that this layer binds.
fn texture_access(texture: &naga::TypeInner) -> Option<Access> {
    match *texture {
        naga::TypeInner::Image { dim: naga::ImageDimension::D2, arrayed: true, class } => match class {
            naga::ImageClass::Sampled { kind: naga::ScalarKind::Float, multi: false } => Some(Access::Layers),
            naga::ImageClass::Depth { multi: false } => Some(Access::DepthLayers),
            _ => None,
        },
        _ => None,
    }
}

fn stage_of(stage: naga::ShaderStage) -> wgpu::ShaderStages {
    match stage {
        naga::ShaderStage::Vertex => wgpu::ShaderStages::VERTEX,
        naga::ShaderStage::Fragment => wgpu::ShaderStages::FRAGMENT,
        _ => wgpu::ShaderStages::COMPUTE,
    }
}

/// Checks the host's declaration against the WGSL: the same names, and for each the same access, stride and fields.
///
/// # Errors
/// [`GpuError::Interface`] names the first difference.
pub(super) fn compare(name: &str, wgsl: &[(u32, Resource)], host: &[Resource]) -> Result<(), GpuError> {
    let differ = |what: String| Err(GpuError::Interface { name: name.to_owned(), what });
    for (_, theirs) in wgsl {
        let resource = &theirs.name;
        let Some(ours) = host.iter().find(|ours| ours.name == theirs.name) else {
            return differ(format!("the WGSL binds \"{resource}\", which the host does not declare"));
        };
        if ours.access != theirs.access {
            return differ(format!("\"{resource}\" is {:?} in the WGSL and {:?} on the host", theirs.access, ours.access));
        }
        if ours.stride != theirs.stride {
            return differ(format!("an element of \"{resource}\" has {} bytes in the WGSL and {} on the host", theirs.stride, ours.stride));
        }
        for index in 0..theirs.fields.len().max(ours.fields.len()) {
            let (theirs, ours) = (theirs.fields.get(index), ours.fields.get(index));
            if theirs != ours {
                let show = |field: Option<&Field>| field.map_or("nothing".to_owned(), ToString::to_string);
                return differ(format!("field {index} of \"{resource}\" is {} in the WGSL and {} on the host", show(theirs), show(ours)));
            }
        }
    }
    match host.iter().find(|ours| !wgsl.iter().any(|(_, theirs)| theirs.name == ours.name)) {
        Some(missing) => differ(format!("the host declares \"{}\", which the WGSL does not bind", missing.name)),
        None => Ok(()),
    }
}
