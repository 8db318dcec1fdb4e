use std::{
    sync::{
        Arc,
        atomic::{AtomicUsize, Ordering},
    },
    thread,
    time::Duration,
};

use overpaint::{
    gpu::{AdapterSummary, PassTime},
    pipeline::{Observer, Progress},
};

crate::suite! { plain: a_stage_entered_again_adds_up, threads_may_time_stages_at_once, the_observer_is_told, a_table_has_one_line_a_stage; }

fn adapter(timestamps: bool) -> AdapterSummary {
    AdapterSummary {
        name: "test adapter".to_owned(),
        driver: "none".to_owned(),
        kind: "software".to_owned(),
        backend: "none".to_owned(),
        max_storage_binding: 0,
        max_buffer: 0,
        max_storage_buffers: 0,
        max_invocations: 0,
        max_workgroup_storage: 0,
        timestamps,
    }
}

fn pass(milliseconds: u64) -> PassTime {
    PassTime { pass: "pass", gpu: Duration::from_millis(milliseconds) }
}

fn a_stage_entered_again_adds_up() {
    let progress = Progress::new(&adapter(true));
    for tile in 0..3 {
        let stage = progress.stage("fit", 100 + tile, 51);
        thread::sleep(Duration::from_millis(2));
        stage.gpu(&[pass(250), pass(250)]);
    }
    progress.stage("fold", 7, 0).gpu(&[]);
    drop(progress.stage("decode", 7, 1));
    let table = progress.report();
    let [fit, fold, decode] = &table.stages[..] else { panic!("{table:?}") };
    assert_eq!((fit.name.as_str(), fit.texels, fit.samples, fit.gpu_seconds, fit.on_adapter), ("fit", 303, 51, Some(1.5), true));
    assert!(fit.wall_seconds >= 0.006 && fit.wall_seconds <= table.wall_seconds, "{table:?}");
    assert_eq!((fold.gpu_seconds, fold.on_adapter), (None, true), "an adapter without timestamps");
    assert_eq!((decode.gpu_seconds, decode.on_adapter), (None, false), "the host");
    let shares: f64 = table.stages.iter().map(|stage| table.share(stage)).sum();
    assert!((shares - 1.0).abs() < 1e-12);
}

fn threads_may_time_stages_at_once() {
    let progress = Progress::new(&adapter(true));
    thread::scope(|scope| {
        for _ in 0..4 {
            scope.spawn(|| (0..100).for_each(|_| progress.stage("decode", 1, 2).gpu(&[pass(1)])));
        }
    });
    let table = progress.report();
    assert_eq!((table.stages.len(), table.stages[0].texels), (1, 400));
    assert!((table.stages[0].gpu_seconds.expect("was timed") - 0.4).abs() < 1e-12);
}

#[derive(Debug, Default)]
struct Counts {
    stages: AtomicUsize,
    expected: AtomicUsize,
    done: AtomicUsize,
}

#[derive(Debug)]
struct Counter(Arc<Counts>);

impl Observer for Counter {
    fn stage(&self, _: &'static str) {
        self.0.stages.fetch_add(1, Ordering::Relaxed);
    }
    fn expect(&self, units: usize) {
        self.0.expected.fetch_add(units, Ordering::Relaxed);
    }
    fn advance(&self, units: usize) {
        self.0.done.fetch_add(units, Ordering::Relaxed);
    }
}

fn the_observer_is_told() {
    let counts = Arc::new(Counts::default());
    let progress = Progress::observed(&adapter(false), Box::new(Counter(counts.clone())));
    progress.expect(5);
    progress.expect(3);
    drop(progress.stage("a", 1, 1));
    drop(progress.stage("a", 1, 1));
    progress.advance(4);
    let read = |count: &AtomicUsize| count.load(Ordering::Relaxed);
    assert_eq!((read(&counts.stages), read(&counts.expected), read(&counts.done)), (2, 8, 4));
}

fn a_table_has_one_line_a_stage() {
    let progress = Progress::new(&adapter(true));
    progress.stage("fit", 1, 1).gpu(&[pass(1)]);
    drop(progress.stage("decode", 1, 1));
    let text = progress.report().to_string();
    let lines: Vec<_> = text.lines().collect();
    assert_eq!(lines.len(), 2, "{text}");
    assert!(lines[0].starts_with("fit ") && lines[0].ends_with("test adapter") && lines[0].contains(" %"), "{text}");
    assert!(lines[1].starts_with("decode ") && lines[1].ends_with("host"), "{text}");
}
