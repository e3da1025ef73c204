//! The loads of an unlike pair as columns: what limiting forms are fitted to.

use scene::{ActiveLoads, LoadSet, PairLoads, SwirlLoads};

/// All scalars of both active spheres in a fixed order.
pub fn columns(loads: &[ActiveLoads; 2]) -> Vec<f64> {
    let of = |loads: &ActiveLoads| -> Vec<f64> {
        let torque = across(loads.pair.set()).then_some(loads.torque_on_other);
        let pair = loads.pair.columns().chain(torque);
        pair.chain(loads.swirl.columns()).collect()
    };
    loads.iter().flat_map(of).collect()
}

/// The loads of `set` from the columns of the set `layout`, which must hold it.
pub fn from_columns(set: LoadSet, layout: LoadSet, columns: &[f64]) -> [ActiveLoads; 2] {
    let (first, second) = columns.split_at(columns.len() / 2);
    [first, second].map(|columns| {
        let (pair, rest) = columns.split_at(layout.column_count().min(columns.len()));
        let (torque, swirl) = rest.split_at(usize::from(across(layout)).min(rest.len()));
        ActiveLoads {
            pair: PairLoads::from_columns(set, layout, pair),
            torque_on_other: torque.first().copied().unwrap_or(0.0),
            swirl: SwirlLoads::from_columns(set, swirl),
        }
    })
}

fn across(set: LoadSet) -> bool {
    set.transverse.any()
}
