//! Memory layout of a value, as host and WGSL each see it.

use bytemuck::Pod;
use half::f16;

/// Kind of a scalar in GPU memory.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Scalar {
    /// 32-bit float.
    F32,
    /// 32-bit unsigned integer.
    U32,
    /// 32-bit signed integer.
    I32,
}

/// One scalar or vector inside a value: its name ("" for a value that is no struct), where it stands and what it is.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Field {
    /// Name as written in the struct; padding fields start with `_` and are not compared.
    pub name: String,
    /// Bytes from the start of the value.
    pub offset: usize,
    /// Kind of its scalars.
    pub scalar: Scalar,
    /// Number of scalars.
    pub count: usize,
}

impl std::fmt::Display for Field {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(out, "{}: {:?} x {} at byte {}", self.name, self.scalar, self.count, self.offset)
    }
}

/// A plain value that can live in a GPU buffer and describes its own layout.
///
/// Implemented for the scalars, for vectors of them, and by [`gpu_struct!`](crate::gpu_struct) for
/// parameter structs.
pub trait GpuValue: Pod {
    /// The value's fields in order of their offsets.
    fn fields() -> Vec<Field>;
}

macro_rules! scalar {
    ($($ty:ty, $scalar:expr, $count:expr);* $(;)?) => {$(
        impl GpuValue for $ty {
            fn fields() -> Vec<Field> {
                vec![Field { name: String::new(), offset: 0, scalar: $scalar, count: $count }]
            }
        }
    )*};
}
scalar! {
    f32, Scalar::F32, 1; [f32; 2], Scalar::F32, 2; [f32; 3], Scalar::F32, 3; [f32; 4], Scalar::F32, 4;
    u32, Scalar::U32, 1; [u32; 2], Scalar::U32, 2; [u32; 4], Scalar::U32, 4;
    i32, Scalar::I32, 1;
}

/// Eight halves, which WGSL sees as `vec4<u32>` and opens with `unpack2x16float`: no shader feature is needed for it.
impl GpuValue for [f16; 8] {
    fn fields() -> Vec<Field> {
        <[u32; 4]>::fields()
    }
}

/// Four halves, which WGSL sees as `vec2<u32>`.
impl GpuValue for [f16; 4] {
    fn fields() -> Vec<Field> {
        <[u32; 2]>::fields()
    }
}

/// Declares a `#[repr(C)]` parameter struct once, with the layout that the WGSL side is checked against.
///
/// Fields that start with `_` are padding.
#[macro_export]
macro_rules! gpu_struct {
    ($(#[$meta:meta])* $vis:vis struct $name:ident { $($(#[$field_meta:meta])* $field_vis:vis $field:ident : $ty:ty),* $(,)? }) => {
        $(#[$meta])*
        #[repr(C)]
        #[derive(Debug, Clone, Copy, Default, bytemuck::Pod, bytemuck::Zeroable)]
        $vis struct $name { $($(#[$field_meta])* $field_vis $field: $ty),* }

        impl $crate::gpu::GpuValue for $name {
            fn fields() -> Vec<$crate::gpu::Field> {
                let mut fields = Vec::new();
                $({
                    let inner = <$ty as $crate::gpu::GpuValue>::fields();
                    fields.extend(inner.into_iter().map(|field| $crate::gpu::Field {
                        name: if field.name.is_empty() { stringify!($field).to_owned() } else { format!("{}.{}", stringify!($field), field.name) },
                        offset: field.offset + std::mem::offset_of!($name, $field),
                        ..field
                    }));
                })*
                fields.retain(|field| !field.name.starts_with('_'));
                fields
            }
        }
    };
}

/// The fields of a WGSL type in the same form, or `None` for a type that no buffer of ours holds.
pub(super) fn wgsl_fields(module: &naga::Module, ty: naga::Handle<naga::Type>) -> Option<Vec<Field>> {
    let leaf = |scalar: naga::Scalar, count: usize| {
        let scalar = match (scalar.kind, scalar.width) {
            (naga::ScalarKind::Float, 4) => Scalar::F32,
            (naga::ScalarKind::Uint, 4) => Scalar::U32,
            (naga::ScalarKind::Sint, 4) => Scalar::I32,
            _ => return None,
        };
        Some(vec![Field { name: String::new(), offset: 0, scalar, count }])
    };
    match &module.types[ty].inner {
        naga::TypeInner::Scalar(scalar) | naga::TypeInner::Atomic(scalar) => leaf(*scalar, 1),
        naga::TypeInner::Vector { size, scalar } => leaf(*scalar, *size as usize),
        naga::TypeInner::Struct { members, .. } => {
            let mut fields = Vec::new();
            for member in members {
                let name = member.name.clone().unwrap_or_default();
                for field in wgsl_fields(module, member.ty)? {
                    let name = if field.name.is_empty() { name.clone() } else { format!("{name}.{}", field.name) };
                    fields.push(Field { name, offset: field.offset + member.offset as usize, ..field });
                }
            }
            fields.retain(|field| !field.name.starts_with('_'));
            Some(fields)
        }
        _ => None,
    }
}
