//! The commands of the book that begin with `mpirun`.

use super::launched::{ended, on_this_machine};
use crate::book::{Page, Run, Start};
use crate::running::Workplace;

/// More ranks than this take long on few cores.
const MOST_RANKS: u32 = 8;

#[test]
fn commands_of_the_book_can_be_run_by_mpirun() {
    let (mut faults, mut count) = (Vec::new(), 0);
    for page in Page::all() {
        let place = Workplace::new();
        for command in &page.commands {
            let Start::Mpi(words, invocation) = &command.start else { continue };
            let run = Run::prepare(&place, command, invocation);
            let [_, ranks, words @ ..] = &words[..] else { panic!("{command} has no number of ranks") };
            let ranks = ranks.parse::<u32>().unwrap().min(MOST_RANKS);
            let mut started = place.invocation("mpirun", &format!("-n {ranks}"));
            started.args(words).arg(&run.program).args(&run.words);
            let output = ended(on_this_machine(&mut started).spawn().unwrap(), &command.text);
            faults.extend(run.fault(&output));
            count += 1;
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
    assert!(count > 5, "{count}");
}
