//! `Cargo.lock`: the packages of a build with versions, checksums and dependencies.

use std::error::Error;
use toml::{Table, Value};

/// A parsed lock file.
#[derive(Debug)]
pub(crate) struct Lock {
    packages: Vec<Locked>,
}

/// One package of it.
#[derive(Debug)]
pub(crate) struct Locked {
    /// Its name.
    pub(crate) name: String,
    /// Its version.
    pub(crate) version: String,
    /// What the registry says of its archive; `None` for a package in a folder.
    pub(crate) checksum: Option<String>,
    /// `name`, or `name version` where there are several of the name.
    dependencies: Vec<String>,
}

impl Lock {
    /// Parses the text of a lock file.
    ///
    /// # Errors
    /// When it is no lock file.
    pub(crate) fn parse(text: &str) -> Result<Self, Box<dyn Error>> {
        let table: Table = text.parse()?;
        let packages = table.get("package").and_then(Value::as_array).ok_or("no packages")?;
        let text = |package: &Value, key| package.get(key)?.as_str().map(str::to_owned);
        let locked = |package: &Value| {
            let list = package.get("dependencies").and_then(Value::as_array);
            let list = list.into_iter().flatten().filter_map(Value::as_str).map(str::to_owned);
            Some(Locked {
                name: text(package, "name")?,
                version: text(package, "version")?,
                checksum: text(package, "checksum"),
                dependencies: list.collect(),
            })
        };
        let packages: Option<Vec<Locked>> = packages.iter().map(locked).collect();
        Ok(Self { packages: packages.ok_or("a package without name or version")? })
    }

    /// The packages of a name, in all their versions.
    pub(crate) fn named(&self, name: &str) -> impl Iterator<Item = &Locked> {
        self.packages.iter().filter(move |package| package.name == name)
    }

    /// The packages that a package depends on.
    pub(crate) fn dependencies(&self, package: &Locked) -> Vec<&Locked> {
        let mut found = Vec::new();
        for dependency in &package.dependencies {
            let mut words = dependency.split(' ');
            let (name, version) = (words.next().unwrap_or_default(), words.next());
            let fits = |found: &&Locked| version.is_none_or(|version| found.version == version);
            found.extend(self.named(name).filter(fits));
        }
        found
    }
}
