//! Files that one process at a time may write.

use std::fs::{File, TryLockError};
use std::ops::{Deref, DerefMut};

/// An open file under its lock, which ends with this value, or with the process.
#[derive(Debug)]
pub struct Locked(File);

/// Another process, or another value of this one, holds the lock.
#[derive(Debug)]
pub struct Taken;

impl Locked {
    /// Takes the lock of `file` without waiting. A file system without locks grants it to everyone.
    ///
    /// # Errors
    /// When it is taken.
    pub fn take(file: File) -> Result<Self, Taken> {
        let is_taken = matches!(file.try_lock(), Err(TryLockError::WouldBlock));
        if is_taken { Err(Taken) } else { Ok(Self(file)) }
    }

    /// Takes part in the lock of `file` without waiting: others may, too, as long as nobody holds it alone.
    ///
    /// # Errors
    /// When somebody does.
    pub fn share(file: File) -> Result<Self, Taken> {
        let is_taken = matches!(file.try_lock_shared(), Err(TryLockError::WouldBlock));
        if is_taken { Err(Taken) } else { Ok(Self(file)) }
    }
}

impl Drop for Locked {
    /// Gives the lock up by name. Closing the file would not: a process that another thread has just started shares the open
    /// file until it runs its own program.
    fn drop(&mut self) {
        // A file system without locks has none to give up.
        let _ = self.0.unlock();
    }
}

impl Deref for Locked {
    type Target = File;

    fn deref(&self) -> &File {
        &self.0
    }
}

impl DerefMut for Locked {
    fn deref_mut(&mut self) -> &mut File {
        &mut self.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_lock_ends_with_its_value_although_a_copy_of_the_file_is_open() {
        let file = tempfile::NamedTempFile::new().expect("a temporary file");
        let open = || File::open(file.path()).expect("a file");
        let locked = Locked::take(open()).expect("free");
        // What a process holds between its start and its program.
        let copy = locked.try_clone().expect("a copy");
        assert!(Locked::take(open()).is_err(), "it is taken");
        drop(locked);
        assert!(Locked::take(open()).is_ok(), "it is free");
        drop(copy);
    }

    #[test]
    fn a_lock_is_shared_by_many_or_held_by_one() {
        let file = tempfile::NamedTempFile::new().expect("a temporary file");
        let open = || File::open(file.path()).expect("a file");
        let both = [Locked::share(open()).expect("free"), Locked::share(open()).expect("shared")];
        assert!(Locked::take(open()).is_err(), "two share it");
        drop(both);
        let alone = Locked::take(open()).expect("free");
        assert!(Locked::share(open()).is_err(), "one holds it");
        drop(alone);
    }
}
