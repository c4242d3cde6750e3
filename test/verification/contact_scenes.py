# SPDX-License-Identifier: BSD-3-Clause
"""Contact without friction where symmetry or Newton gives the answer: oblique bars, a disc in its socket, a T of blocks."""
from math import cos, radians, sin

from harness import ROOT, check, clean, harmos, run

DECKS = ROOT / "test/verification/decks"
QUIET = {"output/fields/every_time": 0.0, "output/fields/at_end": "false"}


def along(r, body, angle):
    a = radians(angle)
    return [px * cos(a) + py * sin(a) for px, py in zip(r[body + ".momentum_x"], r[body + ".momentum_y"])]


def vec(x, y):
    return f"[{x!r}, {y!r}]"


def turned(x, y, angle, shift=(0.0, 0.0)):
    a = radians(angle)
    return vec(x * cos(a) - y * sin(a) + shift[0], x * sin(a) + y * cos(a) + shift[1])


def test_bars_at_20_degrees_turn_round_without_moving_sideways():
    r = harmos(DECKS / "oblique_bars.yaml", QUIET)
    axial = 5.0 * r.first("right.mass")
    check("lateral over axial momentum", max(map(abs, along(r, "right", 110.0))) / axial, 5e-4)
    check("axial momentum turns round, missing part", 1.0 - along(r, "right", 20.0)[-1] / axial, 0.15)
    check("momentum ledger", r.summary["momentum_error"], 1e-12)
    clean(r)


def test_a_disc_in_its_socket_keeps_its_angular_momentum():
    kept = []
    for shift in ((0.0, 0.0), (0.31 * 0.0625, 0.155 * 0.0625)):
        s = {"bodies/disc/shift": vec(*shift), "bodies/socket/shift": vec(*shift), **QUIET}
        r = harmos(DECKS / "socket.yaml", s)
        # About the disc's centre; the offset's moment of the (zero) linear momentum is nothing.
        kept.append(r.last("angular_momentum") / r.first("angular_momentum"))
        print(f"  shift {shift}: kept {kept[-1]:.4f}; lost by contact {r.last('contact_loss'):.2e} J/m, by the remap {r.last('remap_loss'):.2e} J/m")
        clean(r)
    check("angular momentum lost in half a revolution at radius 8 cells", 1.0 - min(kept), 0.025)
    check("dependence on the offset, of the loss", (max(kept) - min(kept)) / (1.0 - min(kept)), 1.0 / 3.0)


def tee(angle, shift):
    pressure, speed = 1e-3 * 2700.0 * 5000.0**2, 100.0
    a = radians(angle)
    s = {f"bodies/{name}/center": turned(x, y, angle, shift) for name, x, y in
         (("slider", 0.0, -0.25), ("left", -0.25, 0.25), ("right", 0.25, 0.25))}
    for name in ("slider", "left", "right"):
        s[f"bodies/{name}/angle"] = angle
        s[f"bodies/{name}/pressure"] = pressure
    s["bodies/slider/velocity"] = vec(speed * cos(a), speed * sin(a))
    for name, sign in (("lower", 1.0), ("upper", -1.0)):
        s[f"bodies/{name}/point"] = turned(0.0, -0.5 * sign, angle, shift)
        s[f"bodies/{name}/normal"] = vec(-sign * sin(a), sign * cos(a))
    r = harmos(DECKS / "tee.yaml", {**s, **QUIET})
    p = along(r, "slider", angle)
    error = max(abs(q - p[0]) for q in p) / p[0]
    print(f"  {angle} degrees, shift {shift}: {error:.2e}, unconverged {r.summary['unconverged_cycles']}")
    clean(r)
    return error


def test_three_blocks_at_a_t_slide_without_drag():
    h = 2.4 / 38
    check("largest change of the slider's momentum", tee(15.0, (0.31 * h, 0.17 * h)), 3e-4)


if __name__ == "__main__":
    run(globals())
