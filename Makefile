# On Debian and Ubuntu both commands first install what the machine lacks besides Rust; elsewhere they use what is there.

# Mesa's device-selection layer looks for a desktop and complains on stderr without one; adapters are ordered by overpaint.
export NODEVICE_SELECT = 1

.PHONY: demo test
demo:
	.ci/vulkan
	cargo run --release -- demo

test:
	.ci/vulkan
	cargo test
	cargo test --doc
