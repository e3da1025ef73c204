//! Mutates the answers of public codes at random and checks that each text gives a submission with finite numbers or one short line, in bounded
//! time and memory: `cargo run --release -p squirmers-compare --example fuzz_submissions -- COUNT SEED`.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicU64, Ordering::SeqCst};
use std::time::{Duration, Instant};

use compare::submission::{Submission, SubmittedModel};
use scene::{Gap, Hydrodynamics, LoadSet};

/// Lines of a text that are mutated, whole gaps of them.
const LINES: usize = 320;

/// Longest message, in bytes.
const LONGEST: usize = 400;

/// Longest time of one text.
const LIMIT: Duration = Duration::from_secs(5);

const NUMBERS: [&str; 20] = [
    "0",
    "-0.0",
    "1",
    "-1",
    "0.1",
    "38",
    "1e308",
    "-1e308",
    "1e-308",
    "5e-324",
    "1e999",
    "-1e999",
    "inf",
    "nan",
    "0x10",
    "1_000",
    "+1",
    "12",
    "",
    "179769313486231570000000000000000000000000000000000000000000000000000000000",
];

const PIECES: [&str; 36] = [
    "#! radius = 1e-300\n",
    "#! radius = 1e300\n",
    "#! radius = 2.5\n",
    "#! viscosity = 1e-308\n",
    "#! viscosity = nan\n",
    "#! viscosity = 1e308\n",
    "#! mode_units = [1e-308, 1e308]\n",
    "#! mode_units = []\n",
    "#! mode_units = [1, 2, 3, 4, 5, 6, 7, 8, 9]\n",
    "#! slip_calibration = [1e300]\n",
    "#! slip_calibration = 2\n",
    "#! interpolation = \"linear\"\n",
    "#! interpolation = \"log-linear\"\n",
    "#! interpolation = \"log-cubic\"\n",
    "#! interpolation = \"none\"\n",
    "#! matrix = \"mobility\"\n",
    "#! matrix = \"resistance\"\n",
    "#! range = [1, 2]\n",
    "#! [model]\n",
    "#! model.x.y.z = 1\n",
    "#! model = \"\"\"\n",
    "#! model = \"\\u001b[31m\"\n",
    "#! call = 1979-05-27T07:32:00Z\n",
    "#! seconds_per_gap = -1\n",
    "#! \u{7f}\u{202e} = 1\n",
    "#!\n",
    "# comment\n",
    "gap,row,col,value\n",
    "gap,name,value\n",
    ",method",
    ",ratio",
    ",error_estimate",
    "B1_1z",
    "\"",
    "X11A - X12A",
    "\u{feff}",
];

/// Steele, Lea & Flood's SplitMix64.
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    fn below(&mut self, count: usize) -> usize {
        (self.next() % count.max(1) as u64) as usize
    }

    fn of<'a>(&mut self, list: &[&'a str]) -> &'a str {
        list[self.below(list.len())]
    }
}

/// Whole gaps of a text, as many as fit in [`LINES`].
fn beginning(text: &str) -> String {
    let lines: Vec<&str> = text.lines().collect();
    let gap = |line: &str| line.split(',').next().unwrap_or_default().to_owned();
    let mut end = lines.len();
    if end > LINES {
        end = LINES;
        while end > 1 && gap(lines[end - 1]) == gap(lines[end]) {
            end -= 1;
        }
    }
    lines[..end].join("\n") + "\n"
}

fn mutate(text: &str, others: &[String], random: &mut Random) -> String {
    let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
    for _ in 0..=random.below(4) {
        let at = random.below(lines.len());
        let place = |random: &mut Random| random.below(lines.len());
        let (one, other) = (place(random), place(random));
        match random.below(8) {
            0 if lines.len() > 1 => drop(lines.remove(at)),
            1 => lines.insert(one, lines[other].clone()),
            2 => lines.swap(one, other),
            // A number or another field, in one line or in all that have the same.
            3 | 4 => {
                let mut fields: Vec<&str> = lines[at].split(',').collect();
                let field = random.below(fields.len());
                let (old, new) = (fields[field].to_owned(), random.of(&NUMBERS));
                fields[field] = new;
                lines[at] = fields.join(",");
                if random.below(4) == 0 {
                    for line in &mut lines {
                        let mut fields: Vec<&str> = line.split(',').collect();
                        if fields.get(field) == Some(&old.as_str()) {
                            fields[field] = new;
                            *line = fields.join(",");
                        }
                    }
                }
            }
            5 => lines.insert(
                random.below(at.min(8) + 1),
                random.of(&PIECES).trim_end().to_owned(),
            ),
            6 => {
                let other = &others[random.below(others.len())];
                let line = other.lines().nth(random.below(LINES)).unwrap_or_default();
                lines.insert(at, line.to_owned());
            }
            _ => {
                let mut bytes = std::mem::take(&mut lines[at]).into_bytes();
                for _ in 0..=random.below(3) {
                    let at = random.below(bytes.len() + 1);
                    let byte = random.next() as u8;
                    match random.below(4) {
                        0 => bytes.insert(at, byte),
                        1 if at < bytes.len() => bytes[at] = byte,
                        2 if at < bytes.len() => drop(bytes.remove(at)),
                        _ => drop(bytes.splice(at..at, random.of(&PIECES).bytes())),
                    }
                }
                lines[at] = String::from_utf8_lossy(&bytes).into_owned();
            }
        }
    }
    if random.below(50) == 0 {
        let long = NUMBERS[19].repeat(200);
        let at = random.below(lines.len());
        lines[at].push_str(&long);
    }
    lines.join(if random.below(20) == 0 { "\r\n" } else { "\n" }) + "\n"
}

/// What is wrong with what became of a text, if anything, and whether it was read.
fn check(text: &str) -> Result<bool, String> {
    let one_line = |message: String| {
        if message.len() >= LONGEST || message.contains(char::is_control) || message.is_empty() {
            Err(format!("message of {} bytes: {message:?}", message.len()))
        } else {
            Ok(())
        }
    };
    let submission = match Submission::parse(text) {
        Ok(submission) => submission,
        Err(error) => return one_line(error.to_string()).map(|()| false),
    };
    let answers = submission.answers();
    if !answers
        .windows(2)
        .all(|two| two[0].gap.eps() < two[1].gap.eps())
    {
        return Err("gaps do not rise".to_owned());
    }
    for answer in answers {
        let calibrated = answer.values.calibrated(submission.header());
        let errors = answer.errors.iter();
        let all = answer.values.iter().chain(errors);
        if let Some((quantity, value)) = all.chain(calibrated.iter()).find(|(_, v)| !v.is_finite())
        {
            return Err(format!("{quantity} = {value}"));
        }
        if answer.values.iter().count() != calibrated.iter().count() {
            return Err("calibration loses values".to_owned());
        }
        if let Some(laws) = &answer.laws {
            let all = [laws.asymmetry.0, laws.images.0, laws.smallest_eigenvalue];
            if !all.iter().all(|value| value.is_finite()) {
                return Err(format!("laws {laws:?}"));
            }
        }
    }
    let model = match SubmittedModel::new(&submission) {
        Ok(model) => model,
        Err(error) => return one_line(error.to_string()).map(|()| true),
    };
    let range = model.range();
    for eps in [
        range.smallest,
        (range.smallest * range.largest).sqrt(),
        range.largest,
    ] {
        let Ok(gap) = Gap::new(eps) else { continue };
        for set in [
            LoadSet::axial(1),
            LoadSet::all(2),
            LoadSet::all(2).with_swirl(1),
        ] {
            match model.interacting_loads_with_swirl(gap, set) {
                Ok((loads, swirl)) => {
                    let named = loads.named().into_iter().chain(swirl.named());
                    if let Some((name, value)) = named.into_iter().find(|(_, v)| !v.is_finite()) {
                        return Err(format!("load {name} = {value} at {eps:e}"));
                    }
                }
                Err(error) => one_line(error.to_string())?,
            }
        }
    }
    Ok(true)
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1);
    let count: u64 = arguments.next().map_or(Ok(10_000), |text| text.parse())?;
    let seed: u64 = arguments.next().map_or(Ok(1), |text| text.parse())?;
    let texts: Vec<String> = fixtures::PEERS
        .iter()
        .map(|(_, text)| beginning(text))
        .collect();
    static CASE: AtomicU64 = AtomicU64::new(0);
    std::thread::spawn(move || {
        loop {
            let before = CASE.load(SeqCst);
            std::thread::sleep(LIMIT);
            if CASE.load(SeqCst) == before {
                println!("case {before} of seed {seed} takes more than {LIMIT:?}");
                std::process::exit(1);
            }
        }
    });
    std::panic::set_hook(Box::new(|_| {}));
    let started = Instant::now();
    let (mut read, mut faults, mut longest) = (0_u64, 0_u64, Duration::ZERO);
    for case in 0..count {
        CASE.store(case + 1, SeqCst);
        // Each case by itself, so that it can be made again.
        let mut random = Random(seed.wrapping_mul(1 << 40).wrapping_add(case));
        let base = random.below(texts.len());
        let text = mutate(&texts[base], &texts, &mut random);
        let before = Instant::now();
        let found = catch_unwind(AssertUnwindSafe(|| check(&text)));
        longest = longest.max(before.elapsed());
        match found {
            Ok(Ok(is_read)) => read += u64::from(is_read),
            other => {
                let what = other.map_or_else(
                    |panic| {
                        let text = panic.downcast_ref::<String>().cloned();
                        format!("panic: {}", text.unwrap_or_default())
                    },
                    |fault| fault.err().unwrap_or_default(),
                );
                faults += 1;
                if faults <= 20 {
                    println!("case {case} from {}: {what}", fixtures::PEERS[base].0);
                    if std::env::var_os("SHOW").is_some() {
                        println!("{text}");
                    }
                }
            }
        }
    }
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let memory = status
        .lines()
        .find(|line| line.starts_with("VmHWM"))
        .unwrap_or("")
        .to_owned();
    println!(
        "{count} texts of seed {seed} in {:.1} s: {read} read, {} refused, {faults} faults; longest {:.1} ms; {memory}",
        started.elapsed().as_secs_f64(),
        count - read - faults,
        1e3 * longest.as_secs_f64()
    );
    if faults > 0 {
        Err("faults were found".into())
    } else {
        Ok(())
    }
}
