//! Which quantities a curve puts together.

use super::*;
use crate::judge::points::made::item;

#[test]
fn each_quantity_is_in_the_group_that_its_name_says() {
    for (group, names) in [
        (Group::Squeezing, &["X11A", "X12A"][..]),
        (Group::Shearing, &["Y11A", "Y12B", "X11C", "Y12C"]),
        (Group::Slip, &["XF1_1", "YT2_2", "YF1_1"]),
        (Group::Velocities, &["x11a", "y12c", "UX1_1", "OY2_2"]),
    ] {
        for name in names {
            assert_eq!(Group::of(item(name)), group, "{name}");
        }
    }
    assert_eq!(Group::of(Item::Approach(5.0)), Group::Approach);
    let titles: std::collections::BTreeSet<_> =
        Group::ALL.iter().map(|group| group.title()).collect();
    assert_eq!(titles.len(), Group::ALL.len());
}
