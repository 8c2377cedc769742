# SPDX-License-Identifier: GPL-2.0-or-later
"""Every kinematics module with random parameters: thousands of random points of its work space go
through both directions and come back (kinscheck), and some of them are compared with the formulas
of the manual, written here a second time. The seed of each set is printed when it fails."""
import math
import random
import subprocess
import tempfile

SETS, POINTS, SHOW = 4, 3000, 40


def sc(deg):
    return math.sin(math.radians(deg)), math.cos(math.radians(deg))


def rot(axis, deg):
    s, c = sc(deg)
    return {"x": [[1, 0, 0], [0, c, -s], [0, s, c]], "y": [[c, 0, s], [0, 1, 0], [-s, 0, c]],
            "z": [[c, -s, 0], [s, c, 0], [0, 0, 1]]}[axis]


def mul(a, b):
    return [[sum(a[i][k] * b[k][j] for k in range(3)) for j in range(3)] for i in range(3)]


def app(a, v):
    return [sum(a[i][k] * v[k] for k in range(3)) for i in range(3)]


def rpy(a, b, c):
    return mul(rot("z", c), mul(rot("y", b), rot("x", a)))


# ---- forward formulas: (parameters, joints) -> pose of nine, None where the module sets nothing ----

def f_corexy(p, j):
    return [(j[0] + j[1]) / 2, (j[0] - j[1]) / 2, *j[2:9]]


def f_rotate(p, j):
    s, c = sc(-j[5])
    return [j[0] * c - j[1] * s, j[0] * s + j[1] * c, *j[2:9]]


def f_max(p, j):  # exact inverse of the manual's inverse
    con = 1 if p["conventional-directions"] else -1
    length = p["pivot-length"] + j[8]
    sb, cb = sc(j[4])
    s, c = sc(j[5])
    x, y = j[0] - con * length * sb - j[6] * cb, j[1] - j[7]
    return [x * c - y * s, x * s + y * c, j[2] - length * cb + con * j[6] * sb + p["pivot-length"], *j[3:9]]


def f_rose(p, j):
    s, c = sc(j[2])
    return [j[0] * c, j[0] * s, j[1], 0, 0, 0, 0, 0, 0]


def f_scorbot(p, j):
    s1, c1 = sc(j[1])
    s2, c2 = sc(j[2])
    s0, c0 = sc(j[0])
    r = 16 + 221 * c1 + 221 * c2
    return [r * c0, r * s0, 140 + 221 * s1 + 221 * s2, j[3], j[4]]


def f_five(p, j):
    (sb, cb), (s, c), r = sc(180 - j[3]), sc(j[4]), p["pivot-length"] + j[5]
    return [j[0] + r * sb * c, j[1] + r * sb * s, j[2] + p["pivot-length"] + r * cb, 0, j[3], j[4], 0, 0, j[5]]


def f_trt(p, j, ac):
    con = 1 if p["conventional-directions"] else -1
    X0, Y0, Z0 = p["x-rot-point"], p["y-rot-point"], p["z-rot-point"]
    dx, dy, dz = p["x-offset"], p["y-offset"], p["z-offset"] + p["tool-offset"]
    (s, c), (sC, cC) = sc(j[3]), sc(j[4])
    if ac:
        X, Y, Z = j[0] - X0, j[1] - dy - Y0, j[2] - dz - Z0
        return [cC * X - con * sC * c * Y + sC * s * Z - con * sC * dy + X0,
                con * sC * X + cC * c * Y - con * cC * s * Z + cC * dy + Y0, con * s * Y + c * Z + dz + Z0, j[3],
                0, j[4]]
    X, Y, Z = j[0] - dx - X0, j[1] - Y0, j[2] - dz - Z0
    return [cC * c * X - con * sC * Y + con * cC * s * Z + cC * dx + X0,
            con * sC * c * X + cC * Y + sC * s * Z + con * sC * dx + Y0, -con * s * X + c * Z + dz + Z0, 0, j[3], j[4]]


def f_tdr(p, j):
    X0, Y0, Z0, dz, dt = p["x-rot-point"], p["y-rot-point"], p["z-rot-point"], p["z-offset"], p["tool-offset-z"]
    (sA, cA), (sB, cB) = sc(j[3]), sc(j[4])
    x, y, z = j[0] - X0, j[1] - Y0, j[2] - Z0 - dt
    return [cB * x + sB * z + X0, sA * sB * x + cA * y - cB * sA * z + sA * dz + Y0,
            -cA * sB * x + sA * y + cA * cB * z - cA * dz + Z0 + dz + dt, j[3], j[4], 0, 0, 0, 0]


def f_trsrn(p, j, acb, tool):
    Dt, Lz, Dx, Dy = p["tool-offset-z"], p["z-pivot"], p["x-offset"], p["y-offset"]
    L = p["y-pivot"] if acb else p["x-pivot"]
    E = Dt + Lz
    (Sv, Cv), Stc, Ctc = sc(p["nut-angle"]), math.sin(p["pre-rot"]), math.cos(p["pre-rot"])
    (Ss, Cs) = sc(p["secondary-angle"] if tool else (j[4] if acb else j[3]))
    (Sp, Cp) = sc(p["primary-angle"] if tool else j[5])
    (Sw, Cw) = sc(j[3] if acb else j[4])
    r, s, t = Cs + Sv * Sv * (1 - Cs), Cs + Cv * Cv * (1 - Cs), Sv * Cv * (1 - Cs)
    K, M = Cv * Ss, Sv * Ss
    Px, Py, Pz = j[:3]
    rest = [*j[3:6], 0, 0, 0]
    if tool:
        g1, g2, g3, g4 = Cs * Ctc - K * Stc, Ctc * K + Stc * r, Ctc * K + Cs * Stc, K * Stc - Ctc * r
        if acb:
            return [(g1 * Cp - g2 * Sp) * (Dx + Px) - g1 * Dx + (g2 * Cp + g1 * Sp) * (Dy + L + Py) - g2 * Dy
                    - (Ctc * M - Stc * t) * (Lz + Pz) - L * Stc,
                    -(g3 * Cp - g4 * Sp) * (Dx + Px) + g3 * Dx - (g4 * Cp + g3 * Sp) * (Dy + L + Py) + g4 * Dy
                    - Ctc * L + (Stc * M + Ctc * t) * (Lz + Pz),
                    (Cp * M - Sp * t) * (Dx + Px) + (Sp * M + Cp * t) * (Dy + L + Py) - Dx * M + (Lz + Pz) * s
                    - Dy * t - Lz, *rest]
        return [-(g4 * Cp + g3 * Sp) * (Dx + L + Px) + g4 * Dx + (g3 * Cp - g4 * Sp) * (Dy + Py) - g3 * Dy - Ctc * L
                + (Stc * M + Ctc * t) * (Lz + Pz),
                -(g2 * Cp + g1 * Sp) * (Dx + L + Px) + g2 * Dx + (g1 * Cp - g2 * Sp) * (Dy + Py) - g1 * Dy
                + (Ctc * M - Stc * t) * (Lz + Pz) + L * Stc,
                (Sp * M + Cp * t) * (Dx + L + Px) - (Cp * M - Sp * t) * (Dy + Py) + Dy * M + (Lz + Pz) * s - Dx
                * t - Lz, *rest]
    Rz = p["z-rot-axis"] - Lz
    if acb:
        Ry = p["y-rot-axis"] - (Dy + L)
        return [-(Cp * M - Sp * t) * E - Cp * Dx + (Cp * K + Sp * r) * L + Dy * Sp + Dx + Px,
                -Cp * Cw * Dy - Cw * Dx * Sp - Cw * (Ry - Py) - (Cw * Sp * M + Cp * Cw * t - Sw * s) * E
                + (K * Cw * Sp - Cp * Cw * r + Sw * t) * L + (Rz - Pz) * Sw + Ry + Dy + L,
                -Cp * Dy * Sw - Dx * Sp * Sw - Cw * (Rz - Pz) - (Sp * M * Sw + Cp * Sw * t + Cw * s) * E
                + (K * Sp * Sw - Cp * Sw * r - Cw * t) * L - (Ry - Py) * Sw + Rz + Dt + Lz, *rest]
    Rx = p["x-rot-axis"] - L - Dx
    return [-Cp * Cw * Dx + Cw * Dy * Sp - Cw * (Rx - Px) - (Cw * Sp * M + Cp * Cw * t + Sw * s) * E
            + (K * Cw * Sp - Cp * Cw * r - Sw * t) * L - (Rz - Pz) * Sw + Rx + Dx + L,
            (Cp * M - Sp * t) * E - Cp * Dy - (Cp * K + Sp * r) * L - Dx * Sp + Dy + Py,
            Cp * Dx * Sw - Dy * Sp * Sw - Cw * (Rz - Pz) + (Sp * M * Sw + Cp * Sw * t - Cw * s) * E
            - (K * Sp * Sw - Cp * Sw * r + Cw * t) * L + (Rx - Px) * Sw + Rz + Dt + Lz, *rest]


def f_millturn(p, j):
    return [j[2], -j[1], j[0], j[3]]


def f_scara(p, j):
    (s0, c0), (s1, c1), (s3, c3) = sc(j[0]), sc(j[0] + j[1]), sc(j[0] + j[1] + j[3])
    return [p["D2"] * c0 + p["D4"] * c1 + p["D6"] * c3, p["D2"] * s0 + p["D4"] * s1 + p["D6"] * s3,
            p["D1"] + p["D3"] - j[2] - p["D5"], j[4], j[5], j[0] + j[1] + j[3]]


def f_arm(p, j):
    A1, D1 = p.get("A1", 0), p.get("D1", 0)
    D = p["D2"] + p["D3"] if "D2" in p else p["D3"]
    (s1, c1), (s2, c2), (s4, c4), (s5, c5), (s6, c6) = (sc(j[i]) for i in (0, 1, 3, 4, 5))
    s23, c23 = sc(j[1] + j[2])
    T1, T3 = c4 * c5 * c6 - s4 * s6, s4 * c5 * c6 + c4 * s6
    T4 = c23 * T1 - s23 * s5 * c6
    X = [c1 * T4 + s1 * T3, s1 * T4 - c1 * T3, -s23 * T1 - c23 * s5 * c6]
    T1, T3 = -c4 * c5 * s6 - s4 * c6, c4 * c6 - s4 * c5 * s6
    T4 = c23 * T1 + s23 * s5 * s6
    Y = [c1 * T4 + s1 * T3, s1 * T4 - c1 * T3, -s23 * T1 + c23 * s5 * s6]
    T1 = c23 * c4 * s5 + s23 * c5
    Z = [-c1 * T1 - s1 * s4 * s5, -s1 * T1 + c1 * s4 * s5, s23 * c4 * s5 - c23 * c5]
    T = A1 + p["A2"] * c2 + p["A3"] * c23 - p["D4"] * s23
    at = [c1 * T - D * s1, s1 * T + D * c1, D1 - p["A3"] * s23 - p["A2"] * s2 - p["D4"] * c23]
    return {"tran": [at[i] + p["D6"] * Z[i] for i in range(3)], "rot": [[X[i], Y[i], Z[i]] for i in range(3)]}


def f_genser(p, j):
    R, at, q = [[1, 0, 0], [0, 1, 0], [0, 0, 1]], [0, 0, 0], []
    for i in range(6):
        q.append(j[i] - (p[f"unrotate-{i}"] * q[i - 1] if i else 0))
        (st, ct), sa, ca = sc(q[i]), math.sin(p[f"ALPHA-{i}"]), math.cos(p[f"ALPHA-{i}"])
        move = app(R, [p[f"A-{i}"], -sa * p[f"D-{i}"], ca * p[f"D-{i}"]])
        at = [at[k] + move[k] for k in range(3)]
        R = mul(R, [[ct, -st, 0], [st * ca, ct * ca, -sa], [st * sa, ct * sa, ca]])
    return {"tran": at, "rot": R, "uvw": j[6:9]}


def i_tripod(p, w):
    x, y, z = w[:3]
    return [math.dist((x, y, z), b) for b in ((0, 0, 0), (p["Bx"], 0, 0), (p["Cx"], p["Cy"], 0))]


def i_lineardelta(p, w):
    R, L = p["R"], p["L"]
    towers = [(0, R), (-R * math.sqrt(3) / 2, -R / 2), (R * math.sqrt(3) / 2, -R / 2)]
    return [w[2] + math.sqrt(L * L - (tx - w[0]) ** 2 - (ty - w[1]) ** 2) for tx, ty in towers] + list(w[3:9])


def i_rotarydelta(p, w):
    pfr, tl, sl, fr = p["platformradius"], p["thighlength"], p["shinlength"], p["footradius"]
    out = []
    for turn in (0, -120, 120):
        s, c = sc(turn)
        x, y, z = w[0] * c - w[1] * s, w[0] * s + w[1] * c, w[2]
        a = (x * x + (y - fr) ** 2 + z * z + tl * tl - sl * sl - pfr * pfr) / (2 * z)
        b = (fr - pfr - y) / z
        d = tl * tl * (b * b + 1) - (a - b * pfr) ** 2
        ky = (pfr + a * b + math.sqrt(d)) / (b * b + 1)
        out.append(math.degrees(math.atan2(b * ky - a, ky - pfr)))
    return out + list(w[3:9])


BASE = [(-22.95, 13.25, 0), (22.95, 13.25, 0), (22.95, 13.25, 0), (0, -26.5, 0), (0, -26.5, 0), (-22.95, 13.25, 0)]
PLAT = [(-1, 11.5, 0), (1, 11.5, 0), (10.459, -4.884, 0), (9.459, -6.616, 0), (-9.459, -6.616, 0), (-10.459, -4.884, 0)]


def i_hexapod(p, w):
    R, lift = rpy(*w[3:6]), p["tool-offset"] + p["spindle-offset"]
    out = []
    for b, a in zip(BASE, PLAT):
        v = app(R, [a[0], a[1], a[2] + lift])
        out.append(math.dist([w[k] + v[k] for k in range(3)], [b[0], b[1], b[2] + lift]))
    return out


def i_penta(p, w):
    bx, by = (-418.03, 417.96, -418.03, 417.96, -0.06), (324.56, 324.56, -325.44, -325.44, -492.96)
    ez, r = (-185.5, -159.5, -67.5, -41.5, -14), 80.32
    R = mul(rot("y", w[4]), rot("x", w[3]))
    back = [[R[j][i] for j in range(3)] for i in range(3)]
    out = []
    for i in range(5):
        t = p["tool-offset"]
        v = app(back, [bx[i] - w[0], by[i] - w[1], 895.56 + t - w[2]])
        out.append(math.hypot(v[2] - (ez[i] + t), math.hypot(v[0], v[1]) - r))
    return out


LEN = lambda lo, hi: lambda rng: rng.uniform(lo, hi)  # noqa: E731
BIT = lambda rng: rng.choice([0, 1])  # noqa: E731
SMALL = LEN(-30, 30)
XYZ = "-100:100,-100:100,-100:100"
NINE = XYZ + ",-9:9,-9:9,-9:9,-9:9,-9:9,-9:9"
TRT = {n: SMALL for n in ("x-rot-point", "y-rot-point", "z-rot-point", "x-offset", "y-offset", "z-offset")} | {
    "tool-offset": LEN(0, 100), "conventional-directions": BIT}
TRSRN = {"tool-offset-z": LEN(0, 100), "z-pivot": LEN(100, 200), "x-offset": SMALL, "y-offset": SMALL,
         "z-rot-axis": SMALL, "pre-rot": LEN(-1, 1), "nut-angle": LEN(20, 70), "primary-angle": LEN(-90, 90),
         "secondary-angle": LEN(-90, 90)}
FIVE = "-500:500,-500:500,-500:500,-100:100,-400:400"
ARM = "-170:170,-220:40,-50:220,-110:170,-100:100,-260:260"
BENT = "-170:170,-220:40,-50:220,-110:170,10:100,-260:260"

# module, prefix, parameters, kinscheck arguments, forward, inverse
MODULES = [
    ("corexykins", "", {}, f"ranges={NINE}", f_corexy, None),
    ("rotatekins", "", {}, f"ranges={XYZ},-9:9,-9:9,-900:900,-9:9,-9:9,-9:9", f_rotate, None),
    ("maxkins", "maxkins", {"pivot-length": LEN(50, 300), "conventional-directions": BIT},
     f"ranges={XYZ},-9:9,-90:90,-900:900,-9:9,-9:9,-9:9", f_max, None),
    ("rosekins", "", {}, "ranges=1:100,-100:100,-2000:2000", f_rose, None),
    ("tripodkins", "tripodkins", {"Bx": LEN(50, 150), "Cx": LEN(10, 60), "Cy": LEN(50, 150)}, f"by=pose ranges={XYZ}",
     None, i_tripod),
    ("scorbot-kins", "", {}, "ranges=-170:170,10:90,-85:5,-9:9,-9:9", f_scorbot, None),
    ("lineardeltakins", "lineardeltakins", {"R": LEN(100, 140), "L": LEN(240, 300)},
     "by=pose ranges=-80:80,-80:80,-300:100,-9:9,-9:9,-9:9,-9:9,-9:9,-9:9", None, i_lineardelta),
    ("rotarydeltakins", "rotarydeltakins",
     {"platformradius": LEN(9, 11), "thighlength": LEN(9.5, 11), "shinlength": LEN(14, 16), "footradius": LEN(5, 7)},
     "by=pose ranges=-4:4,-4:4,-18:-9,-9:9,-9:9,-9:9,-9:9,-9:9,-9:9", None, i_rotarydelta),
    ("5axiskins", "5axiskins", {"pivot-length": LEN(50, 300)}, f"ranges={FIVE},-50:50", f_five, None),
    ("xyzac-trt-kins", "xyzac-trt-kins", TRT, f"ranges={FIVE}", lambda p, j: f_trt(p, j, True), None),
    ("xyzbc-trt-kins", "xyzbc-trt-kins", TRT, f"ranges={FIVE}", lambda p, j: f_trt(p, j, False), None),
    ("xyzab_tdr_kins", "xyzab_tdr_kins",
     {"tool-offset-z": LEN(0, 100), "z-offset": SMALL, "x-offset": SMALL, "x-rot-point": SMALL,
                                          "y-rot-point": SMALL, "z-rot-point": SMALL}, f"type=1 ranges={FIVE}",
                                          f_tdr, None),
    *[(f"xyz{m}_trsrn", f"xyz{m}_trsrn_kins", TRSRN | extra, f"type={1 + tool} ranges={FIVE},-90:90",
       lambda p, j, acb=m == "acb", tool=tool: f_trsrn(p, j, acb, tool), None)
      for m, extra in (("acb", {"y-pivot": SMALL, "y-rot-axis": SMALL}),
                       ("bca", {"x-pivot": SMALL, "x-rot-axis": SMALL}))
      for tool in (0, 1)],
    ("millturn", "", {}, "type=1 ranges=-500:500,-500:500,-500:500,-100:100", f_millturn, None),
    ("userkins", "", {}, f"ranges={XYZ}", lambda p, j: [*j[:3], 0, 0, 0, 0, 0, 0], None),
    ("matrixkins", "matrixkins",
     {f"C_{r}{c}": (LEN(0.9, 1.1) if r == c else LEN(-0.1, 0.1)) for r in "xyz" for c in "xyz"},
     f"by=pose ranges={NINE}", None,
     lambda p, w: app([[p[f"C_{r}{c}"] for c in "xyz"] for r in "xyz"], w[:3]) + list(w[3:9])),
    ("scarakins", "scarakins",
     {"D1": LEN(400, 500), "D2": LEN(300, 350), "D3": SMALL, "D4": LEN(200, 260), "D5": SMALL, "D6": LEN(0, 60)},
     "ranges=-170:170,-150:150,-100:100,-180:180,-9:9,-9:9", f_scara, None),
    ("pumakins", "pumakins", {"A2": LEN(250, 350), "A3": LEN(20, 60), "D3": LEN(20, 80), "D4": LEN(350, 450),
                              "D6": LEN(0, 90)},
     f"ranges={ARM}", f_arm, None),
    ("three21kins", "three21kins",
     {"A1": LEN(20, 70), "A2": LEN(280, 350), "A3": LEN(0, 30), "D1": LEN(100, 200), "D2": SMALL,
                                    "D3": LEN(-9, 9), "D4": LEN(200, 300), "D6": LEN(0, 60)},
     f"ranges={ARM}", f_arm, None),
    ("genserkins", "genserkins", {**{f"A-{i}": LEN(a, a + 20) for i, a in enumerate((0, 0, 290, 45, 0, 0))},
                                  **{f"ALPHA-{i}": (lambda v: lambda rng: v)(v) for i, v in
                                     enumerate((0, -math.pi / 2, 0, -math.pi / 2, math.pi / 2, -math.pi / 2))},
                                  **{f"D-{i}": LEN(d, d + 30) for i, d in enumerate((0, 0, 60, 390, 0, 0))},
                                  **{f"unrotate-{i}": (lambda rng: rng.choice([0, 0, 1, -1])) for i in range(6)}},
     f"perturb=10 joint_tolerance=100000000 ranges={BENT},-9:9,-9:9,-9:9", f_genser, None),
    ("genhexkins", "genhexkins", {"tool-offset": LEN(0, 1), "spindle-offset": LEN(0, 1)},
     "by=pose perturb=10000 ranges=-5:5,-5:5,20:40,-20:20,-20:20,-20:20", None, i_hexapod),
    ("genhexkins", "genhexkins", {"screw-lead": LEN(0.05, 0.3), "tool-offset": LEN(0, 1)},
     "by=pose perturb=10000 ranges=-5:5,-5:5,20:40,-20:20,-20:20,-20:20", None, None),
    ("pentakins", "pentakins", {"tool-offset": LEN(0, 20)},
     "by=pose perturb=50 ranges=-50:50,-50:50,200:400,-15:15,-15:15", None, i_penta),
]


def difference(wanted, pose):
    """Largest difference of what the formula says from a pose of nine."""
    if isinstance(wanted, dict):
        R = rpy(*pose[3:6])
        d = [a - b for a, b in zip(wanted["tran"], pose)] + [wanted["rot"][i][k] - R[i][k] for i in range(3)
                                                             for k in range(3)]
        d += [a - b for a, b in zip(wanted.get("uvw", []), pose[6:9])]
        return max(map(abs, d))
    return max(abs(math.remainder(a - b, 360) if 3 <= i < 6 else a - b) for i, (a, b) in enumerate(zip(wanted, pose)))


def hal(lines):
    with tempfile.NamedTemporaryFile("w", suffix=".hal") as f:
        f.write("\n".join(lines) + "\n")
        f.flush()
        return subprocess.run(["halrun", "-f", f.name], stdin=subprocess.DEVNULL, capture_output=True, text=True)


bad, checked = [], 0
for number, (module, prefix, params, check, forward, inverse) in enumerate(MODULES):
    sets = SETS if params else 1
    for n in range(sets):
        rng = random.Random(1000 * number + n)
        p = {name: make(rng) for name, make in params.items()}
        name = f"{module} set {1000 * number + n}"
        done = hal([f"loadrt {module}", *(f"setp {prefix}.{k} {v!r}" for k, v in p.items()),
                    f"loadrt kinscheck seed={n + 1} points={POINTS} show={SHOW} {check}"])
        text = done.stdout + done.stderr
        if f"kinscheck: {POINTS} points agree, 0 refused, 0 bad" not in text:
            bad.append(f"{name}: " + " ".join(x for x in text.splitlines() if not x.startswith("joints"))[:300])
        shown = [line.split() for line in text.splitlines() if line.startswith("joints")]
        if len(shown) != SHOW:
            bad.append(f"{name}: {len(shown)} points shown")
        for words in shown:
            j, w = [float(x) for x in words[1:10]], [float(x) for x in words[11:20]]
            checked += 1
            if forward:
                d = difference(forward(p, j), w)
            elif inverse:
                d = max(abs(a - b) for a, b in zip(inverse(p, w), j))
            else:
                d = 0
            if not d < 1e-6:
                bad.append(f"{name}: joints {j[:6]} pose {w[:6]} differ from the formula by {d:g}")
                break
print("\n".join(bad) if bad else "all agree")
