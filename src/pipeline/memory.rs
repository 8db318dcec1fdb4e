//! How much a job may hold at once.

/// What may be held at once, in bytes. Beside it a program needs some 200 MiB for itself, its driver and the results.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Memory {
    /// Samples on the host.
    pub host: usize,
    /// Samples on the adapter. The adapter's own limits hold as well.
    pub adapter: u64,
}

impl Memory {
    /// On the adapter, by default: what nearly all have. With thousands of samples a texel it holds some ten thousand texels, which fills a
    /// small adapter; a large one is filled by more.
    pub const ADAPTER: u64 = 1 << 30;

    /// Half of the host's memory that is free, or that its control group leaves, and [`Self::ADAPTER`].
    #[must_use]
    pub fn half_of_free() -> Self {
        let mut system = sysinfo::System::new();
        system.refresh_memory();
        let free = system.cgroup_limits().map_or(u64::MAX, |limits| limits.free_memory).min(system.available_memory());
        // A system that tells nothing.
        let free = if free == 0 { 1 << 31 } else { free };
        Self { host: usize::try_from(free / 2).unwrap_or(usize::MAX), adapter: Self::ADAPTER }
    }
}

impl Default for Memory {
    /// 1 GiB each.
    fn default() -> Self {
        Self { host: 1 << 30, adapter: Self::ADAPTER }
    }
}
