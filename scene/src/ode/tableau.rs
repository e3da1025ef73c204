//! Coefficients of the explicit Dormand-Prince 8(5,3) pair with 7th-order dense output.
//!
//! Source: E. Hairer, S. P. Norsett & G. Wanner, *Solving Ordinary Differential Equations I*, 2nd
//! ed., Springer 1993, sec. II.5 and II.6, code DOP853. The numbers are those of SciPy 1.17.1,
//! `scipy/integrate/_ivp/dop853_coefficients.py` (BSD-3-Clause, Copyright (c) 2001-2002 Enthought,
//! Inc., 2003 SciPy Developers), printed as the shortest decimals that read back to the same bits.
//!
//! Stages count from zero: stage 0 is the derivative at the start of the step, stages 1 to 11 make
//! the step, stage 12 is the derivative at its end and stages 13 to 15 serve the dense output only.
//! Rows are written sparse, as pairs of stage and weight.

/// Weights of the stages that contribute, as `(stage, weight)`.
pub(super) type Weights<const M: usize> = [(usize, f64); M];

/// One stage: its time within the step and the weights of the earlier stages.
pub(super) struct Stage<const M: usize> {
    /// Time of the stage as a fraction of the step.
    pub c: f64,
    /// Row of the Runge-Kutta matrix.
    pub a: Weights<M>,
}

/// The same with the zeros, as the loop over the stages of a step has it.
pub(super) struct Row {
    /// Time of the stage as a fraction of the step.
    pub c: f64,
    /// Row of the Runge-Kutta matrix.
    pub a: [f64; 11],
}

/// Stages 1 to 11.
pub(super) static ROWS: [Row; 11] = [
    STAGE_1.row(),
    STAGE_2.row(),
    STAGE_3.row(),
    STAGE_4.row(),
    STAGE_5.row(),
    STAGE_6.row(),
    STAGE_7.row(),
    STAGE_8.row(),
    STAGE_9.row(),
    STAGE_10.row(),
    STAGE_11.row(),
];

impl<const M: usize> Stage<M> {
    const fn row(&self) -> Row {
        let mut a = [0.0; 11];
        let mut n = 0;
        while n < M {
            let (stage, weight) = self.a[n];
            a[stage] = weight;
            n += 1;
        }
        Row { c: self.c, a }
    }
}

/// Stage 1.
pub(super) const STAGE_1: Stage<1> = Stage {
    c: 0.05260015195876773,
    a: [(0, 0.05260015195876773)],
};

/// Stage 2.
pub(super) const STAGE_2: Stage<2> = Stage {
    c: 0.0789002279381516,
    a: [(0, 0.0197250569845379), (1, 0.0591751709536137)],
};

/// Stage 3.
pub(super) const STAGE_3: Stage<2> = Stage {
    c: 0.1183503419072274,
    a: [(0, 0.02958758547680685), (2, 0.08876275643042054)],
};

/// Stage 4.
pub(super) const STAGE_4: Stage<3> = Stage {
    c: 0.2816496580927726,
    a: [
        (0, 0.2413651341592667),
        (2, -0.8845494793282861),
        (3, 0.924834003261792),
    ],
};

/// Stage 5.
pub(super) const STAGE_5: Stage<3> = Stage {
    c: 0.3333333333333333,
    a: [
        (0, 0.037037037037037035),
        (3, 0.17082860872947386),
        (4, 0.12546768756682242),
    ],
};

/// Stage 6.
pub(super) const STAGE_6: Stage<4> = Stage {
    c: 0.25,
    a: [
        (0, 0.037109375),
        (3, 0.17025221101954405),
        (4, 0.06021653898045596),
        (5, -0.017578125),
    ],
};

/// Stage 7.
pub(super) const STAGE_7: Stage<5> = Stage {
    c: 0.3076923076923077,
    a: [
        (0, 0.03709200011850479),
        (3, 0.17038392571223998),
        (4, 0.10726203044637328),
        (5, -0.015319437748624402),
        (6, 0.008273789163814023),
    ],
};

/// Stage 8.
pub(super) const STAGE_8: Stage<6> = Stage {
    c: 0.6512820512820513,
    a: [
        (0, 0.6241109587160757),
        (3, -3.3608926294469414),
        (4, -0.868219346841726),
        (5, 27.59209969944671),
        (6, 20.154067550477894),
        (7, -43.48988418106996),
    ],
};

/// Stage 9.
pub(super) const STAGE_9: Stage<7> = Stage {
    c: 0.6,
    a: [
        (0, 0.47766253643826434),
        (3, -2.4881146199716677),
        (4, -0.590290826836843),
        (5, 21.230051448181193),
        (6, 15.279233632882423),
        (7, -33.28821096898486),
        (8, -0.020331201708508627),
    ],
};

/// Stage 10.
pub(super) const STAGE_10: Stage<8> = Stage {
    c: 0.8571428571428571,
    a: [
        (0, -0.9371424300859873),
        (3, 5.186372428844064),
        (4, 1.0914373489967295),
        (5, -8.149787010746927),
        (6, -18.52006565999696),
        (7, 22.739487099350505),
        (8, 2.4936055526796523),
        (9, -3.0467644718982196),
    ],
};

/// Stage 11.
pub(super) const STAGE_11: Stage<9> = Stage {
    c: 1.0,
    a: [
        (0, 2.273310147516538),
        (3, -10.53449546673725),
        (4, -2.0008720582248625),
        (5, -17.9589318631188),
        (6, 27.94888452941996),
        (7, -2.8589982771350235),
        (8, -8.87285693353063),
        (9, 12.360567175794303),
        (10, 0.6433927460157636),
    ],
};

/// Stage 13.
pub(super) const STAGE_13: Stage<8> = Stage {
    c: 0.1,
    a: [
        (0, 0.056167502283047954),
        (6, 0.25350021021662483),
        (7, -0.2462390374708025),
        (8, -0.12419142326381637),
        (9, 0.15329179827876568),
        (10, 0.00820105229563469),
        (11, 0.007567897660545699),
        (12, -0.008298),
    ],
};

/// Stage 14.
pub(super) const STAGE_14: Stage<8> = Stage {
    c: 0.2,
    a: [
        (0, 0.03183464816350214),
        (5, 0.028300909672366776),
        (6, 0.053541988307438566),
        (7, -0.05492374857139099),
        (10, -0.00010834732869724932),
        (11, 0.0003825710908356584),
        (12, -0.00034046500868740456),
        (13, 0.1413124436746325),
    ],
};

/// Stage 15.
pub(super) const STAGE_15: Stage<8> = Stage {
    c: 0.7777777777777778,
    a: [
        (0, -0.42889630158379194),
        (5, -4.697621415361164),
        (6, 7.683421196062599),
        (7, 4.06898981839711),
        (8, 0.3567271874552811),
        (12, -0.0013990241651590145),
        (13, 2.9475147891527724),
        (14, -9.15095847217987),
    ],
};

/// Weights of the 8th-order step.
pub(super) const STEP: Weights<8> = [
    (0, 0.054293734116568765),
    (5, 4.450312892752409),
    (6, 1.8915178993145003),
    (7, -5.801203960010585),
    (8, 0.3111643669578199),
    (9, -0.1521609496625161),
    (10, 0.20136540080403034),
    (11, 0.04471061572777259),
];

/// Weights of the 5th-order error estimate.
pub(super) const ERROR_5: Weights<8> = [
    (0, 0.01312004499419488),
    (5, -1.2251564463762044),
    (6, -0.4957589496572502),
    (7, 1.6643771824549864),
    (8, -0.35032884874997366),
    (9, 0.3341791187130175),
    (10, 0.08192320648511571),
    (11, -0.022355307863886294),
];

/// Weights of the 3rd-order error estimate.
pub(super) const ERROR_3: Weights<8> = [
    (0, -0.18980075407240762),
    (5, 4.450312892752409),
    (6, 1.8915178993145003),
    (7, -5.801203960010585),
    (8, -0.4226823213237919),
    (9, -0.1521609496625161),
    (10, 0.20136540080403034),
    (11, 0.02265179219836082),
];

/// Weights of coefficient 3 of the dense output.
pub(super) const DENSE_3: Weights<12> = [
    (0, -8.428938276109013),
    (5, 0.5667149535193777),
    (6, -3.0689499459498917),
    (7, 2.38466765651207),
    (8, 2.117034582445028),
    (9, -0.871391583777973),
    (10, 2.2404374302607883),
    (11, 0.6315787787694688),
    (12, -0.08899033645133331),
    (13, 18.148505520854727),
    (14, -9.194632392478356),
    (15, -4.436036387594894),
];

/// Weights of coefficient 4 of the dense output.
pub(super) const DENSE_4: Weights<12> = [
    (0, 10.427508642579134),
    (5, 242.28349177525817),
    (6, 165.20045171727028),
    (7, -374.5467547226902),
    (8, -22.113666853125306),
    (9, 7.733432668472264),
    (10, -30.674084731089398),
    (11, -9.332130526430229),
    (12, 15.697238121770845),
    (13, -31.139403219565178),
    (14, -9.35292435884448),
    (15, 35.81684148639408),
];

/// Weights of coefficient 5 of the dense output.
pub(super) const DENSE_5: Weights<12> = [
    (0, 19.985053242002433),
    (5, -387.0373087493518),
    (6, -189.17813819516758),
    (7, 527.8081592054236),
    (8, -11.57390253995963),
    (9, 6.8812326946963),
    (10, -1.0006050966910838),
    (11, 0.7777137798053443),
    (12, -2.778205752353508),
    (13, -60.19669523126412),
    (14, 84.32040550667716),
    (15, 11.99229113618279),
];

/// Weights of coefficient 6 of the dense output.
pub(super) const DENSE_6: Weights<12> = [
    (0, -25.69393346270375),
    (5, -154.18974869023643),
    (6, -231.5293791760455),
    (7, 357.6391179106141),
    (8, 93.40532418362432),
    (9, -37.45832313645163),
    (10, 104.0996495089623),
    (11, 29.8402934266605),
    (12, -43.53345659001114),
    (13, 96.32455395918828),
    (14, -39.17726167561544),
    (15, -149.72683625798564),
];
