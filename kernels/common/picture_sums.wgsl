// Sums over the texels of a picture and their folding within a workgroup, in a fixed order: halves of the threads, then quarters, and so
// on. What picture_error and picture_error_sum share.

// All but `texels` over red, green and blue together.
struct PictureSums {
    // reflectance units squared
    squared_error: f32,
    // reflectance units, positive where the picture is too bright
    error: f32,
    squared_original: f32,
    original: f32,
    // of the sRGB values held to 0 .. 1
    squared_shown_error: f32,
    // texels that take part
    texels: f32,
}

const SIZE: u32 = 64u;

var<workgroup> partial: array<PictureSums, SIZE>;

fn joined(a: PictureSums, b: PictureSums) -> PictureSums {
    return PictureSums(
        a.squared_error + b.squared_error,
        a.error + b.error,
        a.squared_original + b.squared_original,
        a.original + b.original,
        a.squared_shown_error + b.squared_shown_error,
        a.texels + b.texels,
    );
}

// The sums of all threads of the workgroup, for its first thread. All threads must call it.
fn fold(local: u32, sums: PictureSums) -> PictureSums {
    partial[local] = sums;
    for (var half = SIZE / 2u; half > 0u; half /= 2u) {
        workgroupBarrier();
        if local < half {
            partial[local] = joined(partial[local], partial[local + half]);
        }
    }
    return partial[local];
}
