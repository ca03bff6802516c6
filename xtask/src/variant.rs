//! What sets the two builds apart: a cargo feature, and the compiler and linker flags.

/// One of the two builds of the engine.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Variant {
    Serial,
    Threads,
}

/// Shared memory must name its ceiling: two models of 53,149 points and 199 modes need more than 1 GiB. Phones
/// refuse to set so much aside; the page then asks for less.
const SHARED_MEMORY_BYTES: u32 = 1 << 31;

/// A page of WebAssembly memory.
const PAGE_BYTES: u32 = 1 << 16;

impl Variant {
    pub(crate) const ALL: [Self; 2] = [Self::Serial, Self::Threads];

    pub(crate) fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|variant| variant.name() == name)
    }

    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Serial => "serial",
            Self::Threads => "threads",
        }
    }

    /// The largest shared memory, in pages; `None` where memory is the module's own.
    pub(crate) fn shared_pages(self) -> Option<u64> {
        (self == Self::Threads).then_some(u64::from(SHARED_MEMORY_BYTES / PAGE_BYTES))
    }

    pub(crate) fn cargo_features(self) -> &'static [&'static str] {
        match self {
            Self::Serial => &["--no-default-features"],
            Self::Threads => &["--no-default-features", "--features", "threads"],
        }
    }

    /// Since Rust 1.96 the compiler leaves the arguments for shared memory to its caller. Without
    /// them the build succeeds, with memory that is not shared.
    pub(crate) fn rustflags(self) -> String {
        match self {
            Self::Serial => "-C target-feature=+simd128".to_owned(),
            Self::Threads => [
                "-C target-feature=+atomics,+bulk-memory,+mutable-globals,+simd128",
                "-C link-arg=--shared-memory",
                &format!("-C link-arg=--max-memory={SHARED_MEMORY_BYTES}"),
                "-C link-arg=--import-memory",
                "-C link-arg=--export=__wasm_init_tls",
                "-C link-arg=--export=__tls_size",
                "-C link-arg=--export=__tls_align",
                "-C link-arg=--export=__tls_base",
            ]
            .join(" "),
        }
    }

    /// What `wasm-opt` may assume of the browser: what the compiler assumed already.
    pub(crate) fn optimiser_features(self) -> Vec<&'static str> {
        let mut features = vec![
            "--enable-simd",
            "--enable-bulk-memory",
            "--enable-bulk-memory-opt",
            "--enable-mutable-globals",
            "--enable-sign-ext",
            "--enable-nontrapping-float-to-int",
            "--enable-reference-types",
            "--enable-multivalue",
        ];
        if self == Self::Threads {
            features.push("--enable-threads");
        }
        features
    }
}
