//! The main job does not depend on how it is cut into blocks and tiles, nor on being killed and taken up again.

use std::fs;

use overpaint::{
    gpu::Gpu,
    io::{IoError, Source, Unfinished},
    model::{FitSettings, SurfaceMode},
    pipeline::{Memory, Observer, Progress, fit_job, fit_within, import},
};

use crate::support::speckle::Speckle;

crate::suite! { gpu: any_tiles_give_the_same_bits, any_tiles_give_the_same_bits_of_a_local_surface, a_dataset_gives_the_bits_of_its_source, kept_tiles_are_taken_up, pairs_may_be_missing; }

const SIZE: [usize; 2] = [9, 7];

fn settings(surface: SurfaceMode) -> FitSettings {
    FitSettings { surface, ..FitSettings::default() }
}

/// The bits of a material.
fn fitted(gpu: &Gpu, source: &dyn Source, memory: Memory, unfinished: Option<&Unfinished>) -> Vec<u32> {
    fitted_as(gpu, source, SurfaceMode::Flat, memory, unfinished)
}

fn fitted_as(gpu: &Gpu, source: &dyn Source, surface: SurfaceMode, memory: Memory, unfinished: Option<&Unfinished>) -> Vec<u32> {
    let progress = Progress::new(gpu.adapter());
    let material = fit_within(gpu, source, &settings(surface), memory, unfinished, &progress).expect("fits");
    let svbrdf = material.svbrdf;
    let mut bits: Vec<u32> = material.height.values().iter().map(|z| z.to_bits()).collect();
    for map in [&svbrdf.diffuse, &svbrdf.lobes[0].specular, &material.normal_measured] {
        bits.extend(map.values().iter().flatten().map(|value| value.to_bits()));
    }
    bits.extend(svbrdf.lobes[0].parameters.values().iter().flatten().map(|value| value.to_bits()));
    bits.extend(material.fit.iterations.values());
    bits
}

/// Memory for a tile of so many texels and two blocks of so many, of 45 samples.
fn memory(tile: usize, block: usize) -> Memory {
    // 45 samples are six octets of three channels; beside three copies of them, the adapter keeps up to 256 bytes a texel.
    Memory { host: 2 * block * 45 * 6, adapter: (tile * (3 * 3 * 6 * 16 + 256)) as u64 }
}

fn any_tiles_give_the_same_bits(gpu: &Gpu) {
    let mut source = Speckle::new(SIZE, 0);
    source.invalid = 200;
    let whole = fitted(gpu, &source, Memory::default(), None);
    assert_eq!(whole.len(), 63 * (1 + 3 * 3 + 4 + 1));
    for chunk in [None, Some([4, 4]), Some([9, 2])] {
        source.chunk = chunk;
        for (tile, block) in [(1, 1), (3, 2), (10, 10), (10, 20), (32, 63), (63, 1000)] {
            assert!(whole == fitted(gpu, &source, memory(tile, block), None), "tiles of {tile} texels, blocks of {block}, {chunk:?}");
        }
    }
}

/// What is chosen by measure, too, and each texel's points in a relief of the whole plane.
fn any_tiles_give_the_same_bits_of_a_local_surface(gpu: &Gpu) {
    // Larger than the texels that are measured, so that these are spread.
    let mut source = Speckle::new([17, 14], 0);
    let local = |source: &Speckle, memory| fitted_as(gpu, source, SurfaceMode::Local, memory, None);
    let whole = local(&source, Memory::default());
    assert!(whole == local(&source, memory(30, 20)), "pictures, a few at a time");
    source.chunk = Some([4, 4]);
    assert!(whole == local(&source, memory(100, 64)), "chunks");
}

fn a_dataset_gives_the_bits_of_its_source(gpu: &Gpu) {
    let mut source = Speckle::new(SIZE, 0);
    source.invalid = 200;
    let folder = tempfile::tempdir().expect("is made");
    let path = folder.path().join("speckle.zarr");
    import(&source, &path, Memory::default(), &Progress::on_host(Box::new(Silent))).expect("imports");
    let dataset = overpaint::io::open(&path).expect("opens");
    assert!(fitted(gpu, &source, Memory::default(), None) == fitted(gpu, dataset.as_ref(), memory(10, 20), None));
}

/// Whatever an earlier run with other memory has kept, and whatever of that is damaged.
fn kept_tiles_are_taken_up(gpu: &Gpu) {
    let source = Speckle::new(SIZE, 0);
    let whole = fitted(gpu, &source, Memory::default(), None);
    let folder = tempfile::tempdir().expect("is made");
    let target = folder.path().join("speckle.zarr");
    let job = fit_job(gpu, &source, &settings(SurfaceMode::Flat));
    let unfinished = Unfinished::begin(&target, &job).expect("begins");
    assert!(!unfinished.is_resumed());
    assert!(whole == fitted(gpu, &source, memory(10, 20), Some(&unfinished)));
    let kept = unfinished.names().expect("is listed");
    assert!(kept.len() >= 10, "{kept:?}");
    drop(unfinished);

    let hidden = folder.path().join(".speckle.zarr.unfinished");
    for (index, name) in kept.iter().enumerate() {
        match index % 4 {
            0 => fs::remove_file(hidden.join(name)).expect("is there"),
            1 => {
                // Of the right length, but another number.
                let mut record = fs::read(hidden.join(name)).expect("is there");
                record[6] ^= 0x40;
                fs::write(hidden.join(name), record).expect("is written");
            }
            2 => fs::write(hidden.join(name), [7; 3]).expect("is written"),
            _ => {}
        }
    }
    let unfinished = Unfinished::begin(&target, &job).expect("begins");
    assert!(unfinished.is_resumed());
    assert!(whole == fitted(gpu, &source, memory(7, 15), Some(&unfinished)));

    // What is kept is really used: a record with another lobe shows in the result.
    let kept = unfinished.names().expect("is listed");
    // Of records of the same texels, the last counts.
    let (name, mut bytes) = kept
        .iter()
        .rev()
        .filter(|name| name.starts_with("reflectance"))
        .find_map(|name| Some((name, unfinished.get(name)?)))
        .expect("is kept");
    bytes[0] ^= 1;
    unfinished.put(name, &bytes).expect("is kept");
    assert!(whole != fitted(gpu, &source, memory(7, 15), Some(&unfinished)));

    drop(unfinished);
    let other = fit_job(gpu, &source, &FitSettings { max_iterations: 3, ..settings(SurfaceMode::Flat) });
    match Unfinished::begin(&target, &other) {
        Err(IoError::OtherJob { differing, .. }) => assert_eq!(differing, "source, settings, adapter and version"),
        found => panic!("{found:?}"),
    }
}

fn pairs_may_be_missing(gpu: &Gpu) {
    let bits = fitted(gpu, &Speckle::new(SIZE, 4), Memory::default(), None);
    assert!(bits != fitted(gpu, &Speckle::new(SIZE, 0), Memory::default(), None), "fewer samples, another fit");
    assert!(bits.iter().all(|&bits| f32::from_bits(bits).is_finite()));
}

#[derive(Debug)]
struct Silent;

impl Observer for Silent {}
