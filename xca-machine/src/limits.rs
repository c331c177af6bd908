//! How much memory is left, and what sets the limit. Linux tells; elsewhere nothing is known.

use super::table::kilobytes;
use std::fs;
use std::path::{Path, PathBuf};

/// What sets a limit to the memory.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Limit {
    Machine,
    /// `ulimit -v`.
    Process,
    /// Of a container, a batch job or a service.
    Group,
}

impl Limit {
    pub(crate) fn words(self) -> &'static str {
        match self {
            Self::Machine => "this machine has",
            Self::Process => "the limit of this process (ulimit -v) has",
            Self::Group => "the memory limit of its cgroup has",
        }
    }
}

/// The bytes that are left below a limit.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Free {
    pub(crate) bytes: u64,
    pub(crate) limit: Limit,
}

/// The least of what the limits leave; `root` is where the file system begins.
pub(crate) fn free_memory(root: &Path) -> Option<Free> {
    let machine = kilobytes(&root.join("proc/meminfo"), "MemAvailable:");
    let all = [
        machine.map(|bytes| Free { bytes, limit: Limit::Machine }),
        of_process(root).map(|bytes| Free { bytes, limit: Limit::Process }),
        of_group(root).map(|bytes| Free { bytes, limit: Limit::Group }),
    ];
    all.into_iter().flatten().min_by_key(|free| free.bytes)
}

/// What the soft limit of the address space leaves.
fn of_process(root: &Path) -> Option<u64> {
    let limits = fs::read_to_string(root.join("proc/self/limits")).ok()?;
    let line = limits.lines().find_map(|line| line.strip_prefix("Max address space"))?;
    let most: u64 = line.split_whitespace().next()?.parse().ok()?;
    let used = kilobytes(&root.join("proc/self/status"), "VmSize:").unwrap_or(0);
    Some(most.saturating_sub(used))
}

/// The files by which a version of control groups tells the memory of one.
struct Files {
    most: &'static str,
    used: &'static str,
    /// What of `memory.stat` the system can take back at once.
    reclaimable: &'static str,
}

const V1: Files = Files {
    most: "memory.limit_in_bytes",
    used: "memory.usage_in_bytes",
    reclaimable: "total_inactive_file ",
};
const V2: Files = Files { most: "memory.max", used: "memory.current", reclaimable: "inactive_file " };

/// What the limits of the control group, and of those that it is in, leave.
fn of_group(root: &Path) -> Option<u64> {
    let table = fs::read_to_string(root.join("proc/self/cgroup")).ok()?;
    let mounted = root.join("sys/fs/cgroup");
    let mut least = None;
    for line in table.lines() {
        let mut parts = line.splitn(3, ':').skip(1);
        let (Some(controllers), Some(path)) = (parts.next(), parts.next()) else { continue };
        let (top, files) = match controllers {
            "" => (mounted.clone(), V2),
            names if names.split(',').any(|name| name == "memory") => (mounted.join("memory"), V1),
            _ => continue,
        };
        // A container may see the path that its group has outside: then its own group is at the top.
        for group in Path::new(path.trim_start_matches('/')).ancestors() {
            let left = left(&top.join(group), &files);
            least = least.into_iter().chain(left).min();
        }
    }
    least
}

fn left(group: &Path, files: &Files) -> Option<u64> {
    let number =
        |file: &str| -> Option<u64> { fs::read_to_string(group.join(file)).ok()?.trim().parse().ok() };
    // Where there is no limit, version 2 has the word `max`.
    let most = number(files.most)?;
    let used = number(files.used).unwrap_or(0);
    Some(most.saturating_sub(used.saturating_sub(reclaimable(group.join("memory.stat"), files))))
}

fn reclaimable(table: PathBuf, files: &Files) -> u64 {
    let text = fs::read_to_string(table).unwrap_or_default();
    let number = text.lines().find_map(|line| line.strip_prefix(files.reclaimable));
    number.and_then(|number| number.trim().parse().ok()).unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use tempfile::TempDir;

    /// A machine with 8000 kB, and an endless address space.
    fn machine() -> TempDir {
        let root = tempfile::tempdir().unwrap();
        write(&root, "proc/meminfo", "MemTotal: 9000 kB\nMemAvailable:    8000 kB\n");
        address_space(&root, "unlimited");
        write(&root, "proc/self/status", "Name: heat\nVmSize:\t  1000 kB\n");
        root
    }

    fn write(root: &TempDir, file: &str, text: &str) {
        let path = root.path().join(file);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, text).unwrap();
    }

    fn address_space(root: &TempDir, soft: &str) {
        let table = format!(
            "Limit                     Soft Limit           Hard Limit           Units     \n\
             Max processes             10                   10                   processes \n\
             Max address space         {soft}               unlimited            bytes     \n"
        );
        write(root, "proc/self/limits", &table);
    }

    fn expect(root: &TempDir, bytes: u64, limit: Limit) {
        assert_eq!(free_memory(root.path()), Some(Free { bytes, limit }));
    }

    #[test]
    fn the_least_of_all_limits_counts() {
        let root = machine();
        expect(&root, 8000 * 1024, Limit::Machine);
        address_space(&root, "5120000");
        expect(&root, 4000 * 1024, Limit::Process);
        address_space(&root, "1000");
        expect(&root, 0, Limit::Process);
        assert_eq!(free_memory(&root.path().join("away")), None);
    }

    #[test]
    fn control_groups_of_version_2() {
        let root = machine();
        write(&root, "proc/self/cgroup", "0::/jobs/7\n");
        write(&root, "sys/fs/cgroup/jobs/7/memory.max", "max\n");
        write(&root, "sys/fs/cgroup/jobs/7/memory.current", "100\n");
        expect(&root, 8000 * 1024, Limit::Machine);
        write(&root, "sys/fs/cgroup/jobs/memory.max", "3000000\n");
        write(&root, "sys/fs/cgroup/jobs/memory.current", "900000\n");
        expect(&root, 2_100_000, Limit::Group);
        // The cache of files is given back.
        write(&root, "sys/fs/cgroup/jobs/memory.stat", "anon 1\ninactive_file 600000\n");
        expect(&root, 2_700_000, Limit::Group);
        write(&root, "sys/fs/cgroup/jobs/7/memory.max", "1000000\n");
        expect(&root, 999_900, Limit::Group);
    }

    #[test]
    fn control_groups_of_version_1() {
        let root = machine();
        write(&root, "proc/self/cgroup", "9:cpu,cpuacct:/docker/a1\n7:memory:/docker/a1\n0::/\n");
        // The path is the one outside of the container.
        write(&root, "sys/fs/cgroup/memory/memory.limit_in_bytes", "4000000\n");
        write(&root, "sys/fs/cgroup/memory/memory.usage_in_bytes", "3000000\n");
        write(&root, "sys/fs/cgroup/memory/memory.stat", "inactive_file 5\ntotal_inactive_file 500000\n");
        expect(&root, 1_500_000, Limit::Group);
        write(&root, "sys/fs/cgroup/memory/memory.limit_in_bytes", "9223372036854771712\n");
        expect(&root, 8000 * 1024, Limit::Machine);
    }
}
