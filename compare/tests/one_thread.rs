//! With a single thread in the pool nothing waits for work that only that thread could do.

#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

use std::sync::mpsc;
use std::time::Duration;

use compare::ModelOptions;
use compare::hard_cases::{Bench, GROUPS};

/// Far longer than the cases take, even unoptimised.
const PATIENCE: Duration = Duration::from_secs(300);

#[test]
fn cases_that_start_threads_and_wait_for_them_end_on_the_only_thread_of_the_pool() {
    rayon::ThreadPoolBuilder::new()
        .num_threads(1)
        .build_global()
        .unwrap();
    let bench = Bench::set_up(&ModelOptions::default()).unwrap();
    let (send, receive) = mpsc::channel();
    // On the thread of the pool, where a sweep over the groups would run them.
    rayon::spawn(move || {
        let machine = GROUPS.iter().find(|group| group.name == "machine").unwrap();
        send.send(machine.rows(&bench)).unwrap();
    });
    let rows = receive.recv_timeout(PATIENCE).unwrap();
    assert!(
        rows.len() > 5 && rows.iter().all(|row| row.holds),
        "{rows:?}"
    );
}
