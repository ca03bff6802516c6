//! Numbers that the paper prints, table by table, as printed; the budgets are those of its section 4.

/// A printed mean with its standard deviation.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct Printed {
    /// Mean.
    pub mean: f64,
    /// Standard deviation.
    pub sd: f64,
}

const fn printed(mean: f64, sd: f64) -> Printed {
    Printed { mean, sd }
}

/// Table 1: one row for each star setting, in the order of [`crate::demos::STAR_ROWS`].
#[derive(Debug, Clone, Copy)]
pub struct Table1Row {
    /// d_G(Î, I).
    pub intersection: Printed,
    /// d_R(D̂₁₂, I) and d_R(D̂₂₁, I).
    pub differences: [Printed; 2],
    /// d_G(Q₁, I) and d_G(Q₂, I).
    pub baselines: [f64; 2],
    /// d_R(D₁₂, I) and d_R(D₂₁, I) of the true differences.
    pub true_differences: [f64; 2],
}

/// Table 1.
pub const TABLE_1: [Table1Row; 6] = [
    Table1Row {
        intersection: printed(0.0260, 0.0086),
        differences: [printed(0.2235, 0.1132), printed(0.1148, 0.0534)],
        baselines: [1.5634, 1.5634],
        true_differences: [0.1781, 0.0911],
    },
    Table1Row {
        intersection: printed(0.0370, 0.0110),
        differences: [printed(0.1165, 0.0556), printed(0.1171, 0.0542)],
        baselines: [1.5583, 1.5583],
        true_differences: [0.0911, 0.0911],
    },
    Table1Row {
        intersection: printed(0.0140, 0.0052),
        differences: [printed(0.2081, 0.1097), printed(0.1150, 0.0540)],
        baselines: [1.5471, 1.5506],
        true_differences: [0.1867, 0.1073],
    },
    Table1Row {
        intersection: printed(0.0323, 0.0094),
        differences: [printed(0.1107, 0.0510), printed(0.1143, 0.0534)],
        baselines: [1.5506, 1.5506],
        true_differences: [0.1126, 0.1073],
    },
    Table1Row {
        intersection: printed(0.0053, 0.0022),
        differences: [printed(0.2692, 0.1571), printed(0.1509, 0.0809)],
        baselines: [1.5240, 1.5440],
        true_differences: [0.2834, 0.1861],
    },
    Table1Row {
        intersection: printed(0.0018, 0.0004),
        differences: [printed(0.3257, 0.1994), printed(0.2243, 0.1293)],
        baselines: [1.4863, 1.5375],
        true_differences: [0.4200, 0.3501],
    },
];

/// d_G(Q₁, Q₂) in every row of table 1.
pub const TABLE_1_A_TO_B: f64 = 2.1211;

/// σ of table 1, for stars of radius 10.
pub const TABLE_1_SIGMA: f64 = 0.003;

/// Table 2: one row for each k, the number of shared basis vectors.
#[derive(Debug, Clone, Copy)]
pub struct Table2Row {
    /// d_G(Î, I).
    pub intersection: Printed,
    /// d_G(Q₁, I), d_G(Q₂, I) and d_G(Q₁, Q₂).
    pub baselines: [f64; 3],
}

/// Table 2, k = 1 to 5: dimensions 3k, 3k and k.
pub const TABLE_2: [Table2Row; 5] = [
    Table2Row { intersection: printed(0.0032, 0.0010), baselines: [1.5517, 1.5532, 2.1854] },
    Table2Row { intersection: printed(0.0645, 0.0455), baselines: [2.1641, 2.1855, 3.0835] },
    Table2Row { intersection: printed(0.0877, 0.0178), baselines: [2.6375, 2.6901, 3.7747] },
    Table2Row { intersection: printed(0.1683, 0.0106), baselines: [3.1004, 3.0849, 4.3563] },
    Table2Row { intersection: printed(0.1939, 0.0433), baselines: [3.4606, 3.4467, 4.8682] },
];

/// σ of table 2, in mm.
pub const TABLE_2_SIGMA: f64 = 0.3;

/// Basis vectors that the paper says it split.
pub const TABLE_2_VECTORS: usize = 15;

/// Draws that the paper hands to its principal components, both sides together.
pub const DRAWS: usize = 5000;

/// A budget of the paper's sampler, on each side.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Budget {
    /// Number of chains.
    pub chains: usize,
    /// Steps of each chain, the burn-in included.
    pub steps: usize,
    /// Steps thrown away.
    pub burn_in: usize,
}

/// The stars.
pub const TABLE_1_BUDGET: Budget = Budget { chains: 15, steps: 2500, burn_in: 1000 };

/// The basis splits.
pub const TABLE_2_BUDGET: Budget = Budget { chains: 25, steps: 5000, burn_in: 2000 };
