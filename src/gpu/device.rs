//! Adapters and the device opened on one of them.

use pollster::block_on;

use super::{GpuError, Kernel, Raster, Recorder, Submission, kernel::Built, raster::Draws};

/// What a user needs to know to choose an adapter.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct AdapterSummary {
    /// Name as the driver gives it.
    pub name: String,
    /// Driver and its version.
    pub driver: String,
    /// Discrete, integrated, virtual or software.
    pub kind: String,
    /// Graphics interface: Vulkan, Metal or DirectX 12.
    pub backend: String,
    /// Largest storage binding in bytes.
    pub max_storage_binding: u64,
    /// Largest buffer in bytes.
    pub max_buffer: u64,
    /// Storage buffers that one shader stage may bind.
    pub max_storage_buffers: u32,
    /// Invocations in a workgroup.
    pub max_invocations: u32,
    /// Workgroup memory in bytes.
    pub max_workgroup_storage: u32,
    /// Whether passes can be timed on the adapter itself.
    pub timestamps: bool,
}

impl AdapterSummary {
    fn new(adapter: &wgpu::Adapter) -> Self {
        let (info, limits) = (adapter.get_info(), adapter.limits());
        let kind = match info.device_type {
            wgpu::DeviceType::DiscreteGpu => "discrete GPU",
            wgpu::DeviceType::IntegratedGpu => "integrated GPU",
            wgpu::DeviceType::VirtualGpu => "virtual GPU",
            wgpu::DeviceType::Cpu => "software",
            wgpu::DeviceType::Other => "other",
        };
        Self {
            name: info.name,
            driver: format!("{} {}", info.driver, info.driver_info).trim().to_owned(),
            kind: kind.to_owned(),
            backend: info.backend.to_string(),
            max_storage_binding: limits.max_storage_buffer_binding_size,
            max_buffer: limits.max_buffer_size,
            max_storage_buffers: limits.max_storage_buffers_per_shader_stage,
            max_invocations: limits.max_compute_invocations_per_workgroup,
            max_workgroup_storage: limits.max_compute_workgroup_storage_size,
            timestamps: adapter.features().contains(wgpu::Features::TIMESTAMP_QUERY),
        }
    }
}

fn enumerate() -> Vec<wgpu::Adapter> {
    let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle());
    let mut adapters = block_on(instance.enumerate_adapters(wgpu::Backends::PRIMARY));
    // Hardware before software, and the faster kind first; the driver's own order inside a kind.
    adapters.sort_by_key(|adapter| match adapter.get_info().device_type {
        wgpu::DeviceType::DiscreteGpu => 0,
        wgpu::DeviceType::IntegratedGpu => 1,
        wgpu::DeviceType::VirtualGpu => 2,
        wgpu::DeviceType::Other => 3,
        wgpu::DeviceType::Cpu => 4,
    });
    adapters
}

/// The adapters of this machine, the one used by default first.
#[must_use]
pub fn adapters() -> Vec<AdapterSummary> {
    enumerate().iter().map(AdapterSummary::new).collect()
}

/// An open device with its queue: what every stage is built on.
#[derive(Debug)]
pub struct Gpu {
    pub(super) device: wgpu::Device,
    pub(super) queue: wgpu::Queue,
    pub(super) kernels: Built<String, Kernel>,
    pub(super) rasters: Built<(Draws, String), Raster>,
    adapter: AdapterSummary,
}

impl Gpu {
    /// Opens the first adapter, or the first whose "name (backend)" contains `name` (case does not matter).
    ///
    /// The device is opened with all the limits of the adapter; nothing may be taken for granted above them.
    ///
    /// # Errors
    /// [`GpuError::NoAdapter`], [`GpuError::UnknownAdapter`] or [`GpuError::Device`].
    pub fn open(name: Option<&str>) -> Result<Self, GpuError> {
        let adapters = enumerate();
        if adapters.is_empty() {
            return Err(GpuError::NoAdapter);
        }
        let wanted = name.unwrap_or_default().to_lowercase();
        let described = |adapter: &wgpu::Adapter| {
            let info = adapter.get_info();
            format!("{} ({})", info.name, info.backend).to_lowercase()
        };
        let Some(adapter) = adapters.iter().find(|adapter| described(adapter).contains(&wanted)) else {
            let present: Vec<_> = adapters.iter().map(|adapter| format!("\"{}\"", adapter.get_info().name)).collect();
            return Err(GpuError::UnknownAdapter { wanted: name.unwrap_or_default().to_owned(), present: present.join(", ") });
        };
        let summary = AdapterSummary::new(adapter);
        let descriptor = wgpu::DeviceDescriptor {
            label: Some("overpaint"),
            required_features: adapter.features() & wgpu::Features::TIMESTAMP_QUERY,
            required_limits: adapter.limits(),
            ..Default::default()
        };
        let (device, queue) = block_on(adapter.request_device(&descriptor))
            .map_err(|error| GpuError::Device { adapter: summary.name.clone(), reason: error.to_string() })?;
        Ok(Self { device, queue, kernels: Built::default(), rasters: Built::default(), adapter: summary })
    }

    /// The adapter behind this device.
    #[must_use]
    pub fn adapter(&self) -> &AdapterSummary {
        &self.adapter
    }

    /// Bytes that one storage binding, and so one array of a stage, may have.
    #[must_use]
    pub fn max_array_bytes(&self) -> u64 {
        self.adapter.max_storage_binding.min(self.adapter.max_buffer)
    }

    /// Starts recording commands.
    #[must_use]
    pub fn recorder(&self) -> Recorder<'_> {
        Recorder::new(self)
    }

    /// Submits what was recorded; returns at once.
    pub fn submit(&self, recorder: Recorder<'_>) -> Submission {
        recorder.submit()
    }

    /// Blocks until everything submitted so far has run.
    ///
    /// # Errors
    /// [`GpuError::Lost`] if the device stopped.
    pub fn wait(&self) -> Result<(), GpuError> {
        self.device
            .poll(wgpu::PollType::wait_indefinitely())
            .map(|_| ())
            .map_err(|error| GpuError::Lost { doing: "running submitted work", reason: error.to_string() })
    }
}
