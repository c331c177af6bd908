//! The commands of the book that begin with `mpirun`.

use super::launched::{ended, on_this_machine};
use crate::book::{Page, Start, path, prepare, shortened};
use crate::running::Workplace;

/// More ranks than this tell nothing new on few cores.
const MOST_RANKS: u32 = 8;

#[test]
fn commands_of_the_book_can_be_run_by_mpirun() {
    let mut count = 0;
    for page in Page::all() {
        let place = Workplace::new();
        for command in &page.commands {
            let Start::Mpi(words, invocation) = &command.start else { continue };
            prepare(&place, command);
            let mut words = words.clone();
            let ranks = &mut words[1];
            *ranks = ranks.parse::<u32>().unwrap().min(MOST_RANKS).to_string();
            let invocation = shortened(invocation);
            let begin = std::time::Instant::now();
            let mut started = place.invocation("mpirun", "");
            started.args(words).arg(path(&invocation.program)).args(&invocation.words);
            let output = ended(on_this_machine(&mut started).spawn().unwrap(), &command.text);
            let said = String::from_utf8_lossy(&output.stderr);
            assert!(output.status.success(), "{command}, run as `{invocation}`: {said}");
            eprintln!("TIME {:.2} {command}", begin.elapsed().as_secs_f64());
            count += 1;
        }
    }
    assert!(count > 5, "{count}");
}
