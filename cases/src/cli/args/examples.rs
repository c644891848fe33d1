//! Texts that end the helps.

/// Of the program.
pub const EXAMPLES: &str = "\
Examples:
  anechoic list                                       cases and methods
  anechoic compare compression-1d                     all methods, ranked
  anechoic run compression-1d --method dashpot --set grid.h_m=0.5
  anechoic show compression-1d --toml > my.toml       edit it, then:
  anechoic run my.toml
  anechoic ablation point-source                      what each part of a method absorbs
  anechoic converge lamb --over grid.h_m=20,10        the order with which errors fall
  anechoic sweep point-source --over pml.thickness_m=100..400:100
  anechoic plan --into plan -- sweep appendix-a       the same in shards, on a cluster
  anechoic atlas point-source                         reflection of plane waves by angle
  anechoic report results                             rebuild the report from records
  anechoic diff before after                          what moved between two results
  anechoic score compression-1d series.csv            another program's series beside ours

Exit codes: 0 pass, 1 a claim failed (diff: something changed), 2 usage or input (an output
folder that cannot be written included), 3 a run failed or was stopped, a record is damaged, or
a result could not be written midway, 4 a reference is missing.";

/// Of `run` and `compare`.
pub const SOLVE_EXAMPLES: &str = "\
Examples:
  anechoic compare compression-1d --profile gate --jobs 2
  anechoic compare compression-1d --set dashpot.impedance=0.5 --filter dashpot
  anechoic run my.toml --format json > rows.json
  anechoic compare point-source --resume              after a stop or a kill
  anechoic run compression-1d --method damping-layer --dry-run";

/// Of `converge`.
pub const CONVERGE_EXAMPLES: &str = "\
Examples:
  anechoic converge lamb --over grid.h_m=20,10,5
  anechoic converge compression-1d --over grid.h_m=4,2,1,0.5 --set source.wavelet=sine-squared
  anechoic converge lamb --over grid.h_m=20,10,5 --over time.dt_s=0.02,0.01,0.005 --budget
  anechoic converge lamb --method pml --budget        shares of space, time, boundary, reference";

/// Of `sweep`.
pub const SWEEP_EXAMPLES: &str = "\
The scene is a case, a file, or a named sweep (`list` has all): appendix-a, or a part of it, as appendix-a/thickness.

Examples:
  anechoic sweep point-source --over pml.thickness_m=100..400:100
  anechoic sweep point-source --over pml.thickness_m,damping-layer.thickness_m=200,400,800
  anechoic sweep compression-1d --over grid.h_m=2,1 --over dashpot.impedance=0.5,1,2
  anechoic sweep point-source --method pml-stretched \\
    --over pml-stretched.alpha=0.8..4:0.8/pml-stretched.thickness_m=200..1000:200
  anechoic sweep s21-layer                            the printed damping layer of S21
  anechoic sweep appendix-a --dry-run                 all points of K25, Appendix A";

/// Of `tradeoff`.
pub const TRADEOFF_EXAMPLES: &str = "\
Examples:
  anechoic tradeoff point-source                      which method, how thick, at what cost
  anechoic tradeoff compression-1d --method pml --method dashpot
  anechoic tradeoff my.toml --repeats 5";

/// Of `stability`.
pub const STABILITY_EXAMPLES: &str = "\
A run that grows, diverges or does not converge is a result here, and ends with 0; a method that
theory says is stable and that is not ends with 1.

Examples:
  anechoic stability point-source --profile gate      a few minutes
  anechoic stability compression-1d --method pml --method dashpot
  anechoic stability my.toml";

/// Of `plan`.
pub const PLAN_EXAMPLES: &str = "\
Start them from this folder; the files say how. DIR/done tells what has been done.

Examples:
  anechoic plan --into plan -- sweep appendix-a --profile paper
  snakemake -s plan/Snakefile --cores 2                        on this machine
  snakemake -s plan/Snakefile --profile plan/profile           on Slurm
  sbatch --dependency=afterany:$(sbatch --parsable plan/slurm.sh) plan/slurm-merge.sh";
