//! The picture that the source's camera would have recorded, from a BTF compressed by local PCA. Kernels `lpca_blend` and
//! `reconstruct_lpca`, twin [`reference::reconstruct_lpca`](crate::reference::reconstruct_lpca).
//!
//! All pixels of such a picture have one view and one light, so that each term is interpolated between the nine measured pairs around them
//! once, and texels take it from there. What the pictures of a renderer evaluate at each pixel (`compressed_radiance` in
//! `kernels/common/lpca.wgsl`) is the same sum in another order.
//!
//! A measured BTF has its own parallax, masking and shadows, as seen on the base plane: no relief moves or shadows anything here. A view or
//! light below the horizon gives a black picture.

use crate::{
    data::Direction,
    gpu::{Buffer, Gpu, GpuError, Grid, Kernel, Recorder, Resource, bind},
    gpu_struct,
    model::TexelSamples,
    stage::CompressedBtf,
    wgsl,
};

gpu_struct! {
    struct Directions { view: [f32; 4], light: [f32; 4] }
}

/// The stage's kernels on one device.
#[derive(Debug)]
pub struct ReconstructLpca {
    blend: Kernel,
    picture: Kernel,
}

impl ReconstructLpca {
    /// Builds the kernels.
    ///
    /// # Errors
    /// [`GpuError`] if the driver refuses one.
    pub fn new(gpu: &Gpu) -> Result<Self, GpuError> {
        let kernel = |source, own: [Resource; 2]| Kernel::new(gpu, source, wgsl::ALL, &[&CompressedBtf::resources()[..], &own].concat());
        let blend = [Resource::uniform::<Directions>("seen"), Resource::read_write::<[f32; 4]>("blended")];
        let picture = [Resource::read::<[f32; 4]>("blended"), Resource::read_write::<[f32; 4]>("picture")];
        Ok(Self { blend: kernel(&wgsl::LPCA_BLEND, blend)?, picture: kernel(&wgsl::RECONSTRUCT_LPCA, picture)? })
    }

    /// The picture `[row][column]` of `btf` in reflectance units (π·L_o/E), fourth component 1.
    ///
    /// # Errors
    /// [`GpuError`] if the result does not fit the adapter.
    pub fn record(
        &self, recorder: &mut Recorder<'_>, btf: &CompressedBtf, texel_samples: TexelSamples, view: Direction, light: Direction,
    ) -> Result<Buffer<[f32; 4]>, GpuError> {
        let [width, height] = btf.size();
        let picture = recorder.gpu().fresh("reconstructed picture", width as usize * height as usize)?;
        self.record_into(recorder, btf, texel_samples, view, light, &picture)?;
        Ok(picture)
    }

    /// As [`Self::record`], over a picture that was there before.
    ///
    /// # Errors
    /// [`GpuError`] if the adapter is out of memory.
    ///
    /// # Panics
    /// If the picture has not one pixel a texel: the host's bug.
    pub fn record_into(
        &self, recorder: &mut Recorder<'_>, btf: &CompressedBtf, texel_samples: TexelSamples, view: Direction, light: Direction,
        picture: &Buffer<[f32; 4]>,
    ) -> Result<(), GpuError> {
        let gpu = recorder.gpu();
        let texels = btf.size()[0] as usize * btf.size()[1] as usize;
        assert_eq!(picture.len(), texels, "pixels of the picture");
        let vector = |direction: Direction| direction.vector().as_vec3().extend(0.0).to_array();
        let seen = gpu.uniform("view and light", &Directions { view: vector(view), light: vector(light) })?;
        let params = btf.params(gpu, texel_samples)?;
        let blended = gpu.fresh::<[f32; 4]>("blended terms", btf.terms())?;
        let common = btf.binds(&params);
        let binds = [&common[..], &[bind("seen", &seen), bind("blended", &blended)]].concat();
        recorder.dispatch(&self.blend, &binds, Grid::threads(btf.terms()))?;
        let binds = [&common[..], &[bind("blended", &blended), bind("picture", picture)]].concat();
        recorder.dispatch(&self.picture, &binds, Grid::threads(texels))
    }
}
