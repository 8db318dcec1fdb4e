//! Errors of the GPU layer.

/// What can go wrong between the host and an adapter.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum GpuError {
    /// No driver offers an adapter.
    #[error(
        "no GPU adapter was found. Install a driver; on Debian or Ubuntu the software driver is one command: \
         sudo apt-get install -y libvulkan1 mesa-vulkan-drivers"
    )]
    NoAdapter,
    /// The adapter named by the user is not among those present.
    #[error("no adapter's name contains \"{wanted}\"; there are: {present}. Choose one of these (`overpaint adapters` lists them)")]
    UnknownAdapter {
        /// What the user asked for.
        wanted: String,
        /// The names of the adapters that are there.
        present: String,
    },
    /// The driver would not open a device.
    #[error("adapter \"{adapter}\" would not open a device: {reason}. Update its driver or choose another with --adapter")]
    Device {
        /// The adapter's name.
        adapter: String,
        /// The driver's reason.
        reason: String,
    },
    /// A buffer is larger than the adapter allows.
    #[error(
        "buffer \"{label}\" needs {bytes} bytes, but adapter \"{adapter}\" allows {limit} ({limit_name}). \
         Use an adapter with larger limits (`overpaint adapters` lists them) or crop the images"
    )]
    TooLarge {
        /// The buffer's name.
        label: String,
        /// Its size in bytes.
        bytes: u64,
        /// The adapter's name.
        adapter: String,
        /// The limit in bytes.
        limit: u64,
        /// WebGPU's name of the limit.
        limit_name: &'static str,
    },
    /// A picture is empty or larger than the adapter can draw.
    #[error(
        "a picture of {width} x {height} pixels was asked for, but adapter \"{adapter}\" draws 1 to {limit} either way. Choose another size"
    )]
    PictureSize {
        /// Columns asked for.
        width: u32,
        /// Rows asked for.
        height: u32,
        /// The adapter's name.
        adapter: String,
        /// Most columns or rows.
        limit: u32,
    },
    /// A grid of workgroups exceeds what a dispatch can hold.
    #[error(
        "kernel \"{kernel}\" needs {groups} workgroups, but a dispatch holds {limit}. Use an adapter with larger limits or crop the images"
    )]
    GridTooLarge {
        /// The kernel's name.
        kernel: &'static str,
        /// Workgroups needed.
        groups: u64,
        /// Workgroups allowed.
        limit: u64,
    },
    /// The adapter ran out of memory.
    #[error(
        "the adapter has no memory left for buffer \"{label}\" of {bytes} bytes. Close other programs that use the GPU, or crop the images"
    )]
    OutOfMemory {
        /// The buffer's name.
        label: String,
        /// Its size in bytes.
        bytes: u64,
    },
    /// The device stopped answering.
    #[error("the GPU stopped while {doing}: {reason}. Its driver may have reset it; run again, and update the driver if it recurs")]
    Lost {
        /// What was being done.
        doing: &'static str,
        /// The driver's reason.
        reason: String,
    },
    /// A WGSL file could not be joined with what it imports.
    #[error(transparent)]
    Link(#[from] LinkError),
    /// A WGSL file is not valid.
    #[error("{name}.wgsl is not valid WGSL:\n{message}")]
    Shader {
        /// Stem of the file.
        name: String,
        /// The validator's message.
        message: String,
    },
    /// Host and WGSL disagree on a resource.
    #[error("{name}.wgsl and its host disagree: {what}")]
    Interface {
        /// Stem of the file.
        name: String,
        /// Which resource or field, and how the two sides differ.
        what: String,
    },
}

/// What can go wrong while WGSL files are joined.
#[derive(Debug, PartialEq, Eq, thiserror::Error)]
pub enum LinkError {
    /// A file imports a name that no file has.
    #[error("{importer}.wgsl imports \"{import}\", which is no file in kernels/, kernels/common/ or shaders/")]
    UnknownImport {
        /// The file with the import line.
        importer: String,
        /// The name imported.
        import: String,
    },
    /// Files import each other in a circle.
    #[error("WGSL files import each other in a circle: {path}. Move what they share into a file of its own")]
    Cycle {
        /// The circle, as `a -> b -> a`.
        path: String,
    },
}
