//! `.btf` containers: what is read, and what each wrong input is told.

pub mod builder;
mod errors;
mod values;

use std::sync::Mutex;

use half::f16;
use overpaint::{
    data::Block,
    io::{self, ReadOptions, Source},
};

use self::builder::{File, Scene, Storage};

pub fn tests() -> Vec<libtest_mimic::Trial> {
    [errors::tests(), values::tests()].into_iter().flatten().collect()
}

const PLAIN: Storage = Storage { scalar: 4, transposed: false };

/// A mask with gaps, among them a whole row of the default scene.
const MASK: [u8; 20] = [1, 0, 1, 1, 0, 0, 0, 0, 0, 0, 1, 1, 255, 1, 1, 0, 1, 0, 0, 1];

/// One file of each kind and order.
pub fn files() -> Vec<(String, File)> {
    let scene = Scene::default();
    let mut files = Vec::new();
    for scalar in [2, 4, 8] {
        for transposed in [false, true] {
            for rotated in [false, true] {
                let storage = Storage { scalar, transposed };
                let what = format!("scalars of {scalar} bytes, transposed {transposed}, rotations {rotated}");
                for extended in [None, Some((0, false)), Some((1, false)), Some((1, true)), Some((2, true))] {
                    files.push((format!("FMF {extended:?}, {what}"), builder::fmf(&scene, rotated, extended, storage)));
                }
                for model in [0, 1, 3, 4, 11] {
                    let mixed = [storage, PLAIN, Storage { scalar: 8, transposed: !transposed }];
                    files.push((format!("DFMF {model}, {what}"), builder::dfmf(&scene, rotated, model, mixed)));
                }
                for legacy in [false, true] {
                    files.push((format!("PVF, legacy {legacy}, {what}"), builder::pvf(&scene, rotated, legacy, storage)));
                }
            }
        }
    }
    for lines in [1, 2, 3, 4, 9] {
        for (sparse, by_rows) in [(false, false), (true, false), (true, true)] {
            for mask in [[1; 20], MASK] {
                files.push((
                    format!("BDI, {lines} rows a chunk, sparse {sparse}, by rows {by_rows}, mask {mask:?}"),
                    builder::bdi(&scene, lines, &mask, sparse, by_rows),
                ));
            }
        }
    }
    files
}

/// The source that bytes are.
#[track_caller]
fn open(bytes: &[u8], options: &ReadOptions) -> Box<dyn Source> {
    io::open_btf_bytes("small", bytes, options).expect("opens")
}

/// Radiance `[sample][channel][texel]` of a block. What is told of progress adds up.
#[track_caller]
fn read(source: &dyn Source, samples: &[usize], block: Block) -> Vec<f16> {
    let mut radiance = vec![f16::from_f32(-7.0); 3 * samples.len() * block.texels()];
    let told = Mutex::new(0);
    source.read(samples, block, &mut radiance, &|more| *told.lock().expect("none panics") += more).expect("is readable");
    assert_eq!(told.into_inner().expect("none panics"), samples.len());
    radiance
}

/// All of it.
#[track_caller]
fn whole(source: &dyn Source) -> Vec<f16> {
    let samples: Vec<usize> = (0..source.btf().pairs().len()).collect();
    read(source, &samples, Block::whole(source.btf().size()))
}
