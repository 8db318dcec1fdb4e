//! A glTF document in the making: what goes into its buffer, and what names it.

use std::mem::size_of_val;

use gltf::json::{
    self, Accessor, Buffer, Image, Index, Root, Texture,
    accessor::{ComponentType, GenericComponentType, Type},
    buffer::{Target, View},
    image::MimeType,
    texture::{Info, MagFilter, MinFilter, Sampler, WrappingMode},
    validation::{Checked::Valid, USize64},
};
use serde_json::Value;

/// A document of one buffer.
#[derive(Default)]
pub(super) struct Document {
    pub root: Root,
    pub bytes: Vec<u8>,
    sampler: Option<Index<Sampler>>,
}

impl Document {
    /// Ends the buffer: the document as JSON, with the buffer at `uri` or in the other chunk of a `.glb`.
    pub(super) fn finish(mut self, uri: Option<String>) -> Result<(Vec<u8>, Vec<u8>), json::Error> {
        let byte_length = USize64::from(self.bytes.len());
        self.root.push(Buffer { byte_length, name: None, uri, extensions: None, extras: None });
        Ok((self.root.to_vec()?, self.bytes))
    }

    /// A view of `bytes`, which starts at a multiple of 4.
    fn view(&mut self, bytes: impl IntoIterator<Item = u8>, target: Option<Target>) -> Index<View> {
        let start = self.bytes.len().next_multiple_of(4);
        self.bytes.resize(start, 0);
        self.bytes.extend(bytes);
        self.root.push(View {
            // The one buffer, which comes last.
            buffer: Index::new(0),
            byte_length: (self.bytes.len() - start).into(),
            byte_offset: Some(start.into()),
            byte_stride: None,
            name: None,
            target: target.map(Valid),
            extensions: None,
            extras: None,
        })
    }

    /// An attribute of vertices of `N` floats; with the smallest and the largest, where they are asked for.
    pub(super) fn vertices<const N: usize>(&mut self, values: &[[f32; N]], bounds: Option<[[f32; N]; 2]>) -> Index<Accessor> {
        self.bytes.reserve(size_of_val(values) + 3);
        let view = self.view(values.iter().flatten().flat_map(|value| value.to_le_bytes()), Some(Target::ArrayBuffer));
        let type_ = [Type::Vec2, Type::Vec3, Type::Vec4][N - 2];
        let accessor = accessor(view, ComponentType::F32, type_, values.len());
        let [min, max] = bounds.map_or([None, None], |bounds| bounds.map(|bound| Some(bound.into_iter().map(Value::from).collect())));
        self.root.push(Accessor { min, max, ..accessor })
    }

    /// Indices of triangles' corners.
    pub(super) fn triangles(&mut self, triangles: &[[u32; 3]]) -> Index<Accessor> {
        let indices = triangles.as_flattened();
        let view = self.view(indices.iter().flat_map(|index| index.to_le_bytes()), Some(Target::ElementArrayBuffer));
        let accessor = accessor(view, ComponentType::U32, Type::Scalar, indices.len());
        self.root.push(accessor)
    }

    /// A texture of a PNG file, which repeats.
    pub(super) fn texture(&mut self, name: &str, png: &[u8]) -> Info {
        let view = self.view(png.iter().copied(), None);
        let sampler = *self.sampler.get_or_insert_with(|| {
            self.root.push(Sampler {
                mag_filter: Some(Valid(MagFilter::Linear)),
                min_filter: Some(Valid(MinFilter::LinearMipmapLinear)),
                wrap_s: Valid(WrappingMode::Repeat),
                wrap_t: Valid(WrappingMode::Repeat),
                ..Sampler::default()
            })
        });
        let source = self.root.push(Image {
            buffer_view: Some(view),
            mime_type: Some(MimeType("image/png".to_owned())),
            name: Some(name.to_owned()),
            uri: None,
            extensions: None,
            extras: None,
        });
        let index = self.root.push(Texture { name: Some(name.to_owned()), sampler: Some(sampler), source, extensions: None, extras: None });
        Info { index, tex_coord: 0, extensions: None, extras: None }
    }
}

fn accessor(view: Index<View>, component_type: ComponentType, type_: Type, count: usize) -> Accessor {
    Accessor {
        buffer_view: Some(view),
        byte_offset: None,
        count: count.into(),
        component_type: Valid(GenericComponentType(component_type)),
        type_: Valid(type_),
        min: None,
        max: None,
        name: None,
        normalized: false,
        sparse: None,
        extensions: None,
        extras: None,
    }
}
