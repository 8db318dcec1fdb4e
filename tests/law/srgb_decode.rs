use overpaint::gpu::Gpu;

use crate::parity::srgb_decode::decode;

crate::suite! { gpu: radiance_rises_with_the_code_from_0_to_1, what_follows_the_last_sample_becomes_zero; }

fn radiance_rises_with_the_code_from_0_to_1(gpu: &Gpu) {
    let codes: Vec<u32> = (0..256).map(|code| code * 0x0001_0101).collect();
    for channel in decode(gpu, &codes, 1, 256).chunks(8 * 256) {
        let decoded = &channel[..256];
        assert!(decoded.windows(2).all(|pair| pair[0] < pair[1]), "{decoded:?}");
        assert_eq!([decoded[0], decoded[255]], [0.0, 1.0]);
    }
}

fn what_follows_the_last_sample_becomes_zero(gpu: &Gpu) {
    let found = decode(gpu, &[u32::MAX; 16 * 5], 9, 5);
    assert!(found.iter().enumerate().all(|(index, value)| *value == if index / 5 % 16 < 9 { 1.0 } else { 0.0 }));
}
