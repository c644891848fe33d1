use super::*;

const STEP: f64 = 0.01;
const SAMPLES: usize = 1001;

/// Frequency of the wave packets (Hz).
const FREQUENCY: f64 = 2.0;

fn series(of: impl Fn(f64) -> f64) -> Vec<f64> {
    (0..SAMPLES).map(|i| of(i as f64 * STEP)).collect()
}

/// A wave packet in the middle of the record, several periods long.
fn packet(phase: f64) -> impl Fn(f64) -> f64 {
    move |t| {
        let from_middle = t - 5.0;
        (2.0 * PI * FREQUENCY * from_middle + phase).cos() * (-from_middle * from_middle).exp()
    }
}

fn traces(components: Vec<Vec<f64>>) -> Traces {
    let trace = Trace {
        name: "A1".to_owned(),
        components,
    };
    Traces::new(series(|t| t), vec![trace]).expect("valid")
}

#[track_caller]
fn misfit(mine: Vec<Vec<f64>>, truth: Vec<Vec<f64>>) -> Misfit {
    let all = misfits(&traces(mine), &traces(truth)).expect("defined");
    assert_eq!(all.len(), 1);
    assert_eq!(all[0].receiver, "A1");
    all[0].clone()
}

#[test]
fn the_reference_itself_is_perfect() {
    let wave = vec![series(packet(0.3)), series(packet(1.0))];
    let same = misfit(wave.clone(), wave);
    assert_eq!((same.envelope, same.phase), (0.0, 0.0));
    assert_eq!(same.goodness(), 10.0);
}

#[test]
fn a_factor_is_envelope_alone() {
    for excess in [0.3, -0.2] {
        let wave = packet(0.0);
        let louder = misfit(
            vec![series(|t| (1.0 + excess) * wave(t))],
            vec![series(&wave)],
        );
        assert!((louder.envelope - excess.abs()).abs() < 1e-12);
        assert!(louder.phase < 1e-9, "{}", louder.phase);
        let goodness = 10.0 * (-excess.abs()).exp();
        assert!((louder.goodness() - goodness).abs() < 1e-11);
    }
}

#[test]
fn a_phase_shift_is_phase_alone() {
    for shift in [0.1, -0.7, 2.5] {
        let shifted = misfit(vec![series(packet(shift))], vec![series(packet(0.0))]);
        let expected = shift.abs() / PI;
        assert!((shifted.phase - expected).abs() < 1e-5, "{shifted:?}");
        assert!(shifted.envelope < 1e-5, "{shifted:?}");
        // The phase decides, as soon as it is the worse of the two.
        assert!((shifted.goodness() - 10.0 * (1.0 - expected)).abs() < 1e-4);
    }
}

#[test]
fn a_delay_is_the_phase_of_its_share_of_a_period() {
    let delay = 0.02;
    let wave = packet(0.0);
    let late = misfit(vec![series(|t| wave(t - delay))], vec![series(&wave)]);
    // The packet's own frequency prevails; those above and below, which shift more and less, give a
    // few per cent more in the mean square.
    let expected = 2.0 * FREQUENCY * delay;
    assert!((late.phase / expected - 1.0).abs() < 0.05, "{late:?}");
    assert!(
        late.envelope > 0.0 && late.envelope < late.phase,
        "{late:?}"
    );
}

#[test]
fn components_join_by_their_energy() {
    let wave = packet(0.0);
    let truth = vec![series(&wave), series(|t| 0.5 * wave(t))];
    let mine = vec![series(&wave), series(|t| 0.75 * wave(t))];
    let joined = misfit(mine, truth);
    let expected = (0.25f64.powi(2) / (1.0 + 0.25)).sqrt();
    assert!((joined.envelope - expected).abs() < 1e-12);
    // A component at rest adds nothing to the reference, and all that is in it to the misfit.
    let still = vec![series(&wave), series(|_| 0.0)];
    let moves = vec![series(&wave), series(|t| 0.1 * wave(t))];
    assert!((misfit(moves, still).envelope - 0.1).abs() < 1e-12);
}

#[test]
fn frequencies_follow_the_reference() {
    let transform = Transform::new(SAMPLES, STEP);
    let lines = vec![transform.spectrum(&series(packet(0.0)))];
    let found = transform.frequencies(&lines, "the packet").expect("a band");
    // A Gaussian of exp(-t^2): the amplitude is a twentieth at sqrt(ln 20)/pi from the middle.
    let half_width = 20f64.ln().sqrt() / PI;
    let (low, high) = (found[0], found[found.len() - 1]);
    assert!((low - (FREQUENCY - half_width)).abs() < transform.line);
    assert!((high - (FREQUENCY + half_width)).abs() < transform.line);
    assert!(found.windows(2).all(|w| w[1] / w[0] < 1.06 && w[1] > w[0]));
}

#[test]
fn noise_beyond_the_references_frequencies_does_not_count() {
    let wave = packet(0.0);
    let noisy = series(|t| wave(t) + 0.5 * (2.0 * PI * 30.0 * t).sin());
    let found = misfit(vec![noisy], vec![series(&wave)]);
    assert!(found.envelope < 1e-2, "{found:?}");
}

#[test]
fn what_cannot_be_compared_is_refused() {
    let wave = series(packet(0.0));
    let good = traces(vec![wave.clone()]);
    let silent = traces(vec![series(|_| 0.0)]);
    assert!(matches!(
        misfits(&good, &silent),
        Err(NormError::ZeroDenominator { .. })
    ));
    let reshaped = traces(vec![wave.clone(), wave.clone()]);
    assert!(matches!(
        misfits(&good, &reshaped),
        Err(NormError::Shape { .. })
    ));
    let other = Trace {
        name: "B".to_owned(),
        components: vec![wave.clone()],
    };
    let other = Traces::new(series(|t| t), vec![other]).expect("valid");
    assert!(matches!(
        misfits(&good, &other),
        Err(NormError::MissingReceiver { .. })
    ));
    let uneven = |_: ()| {
        let trace = Trace {
            name: "A1".to_owned(),
            components: vec![wave.clone()],
        };
        Traces::new(series(|t| t + 0.001 * t * t), vec![trace]).expect("valid")
    };
    assert!(matches!(
        misfits(&uneven(()), &uneven(())),
        Err(NormError::NotUniform { .. })
    ));
    // A slow rise has no frequency that so short a record resolves.
    let slow = traces(vec![series(|t| (-(t - 5.0) * (t - 5.0) / 8.0).exp())]);
    let error = misfits(&slow, &slow).expect_err("too short");
    assert!(matches!(error, NormError::NoBand { .. }), "{error}");
}

#[test]
fn another_program_finds_the_same() {
    // ObsPy 1.5.1, obspy.signal.tf_misfit em and pm with fmin 1.46484375, fmax 2.5390625, nf 11, on
    // a packet that is weaker and late, and its echo.
    let wave = packet(0.0);
    let echo = series(|t| 0.9 * wave(t - 0.03) + 0.3 * wave(t - 2.0));
    let found = misfit(vec![echo], vec![series(&wave)]);
    let near = |value: f64, theirs: f64| (value / theirs - 1.0).abs() < 0.002;
    assert!(near(found.envelope, 0.279098368), "{found:?}");
    assert!(near(found.phase, 0.117851354), "{found:?}");
}
