"""The quick form of each phenomenon: one number, the range in which it must lie, and the control. See check.py.

docs/phenomena has the numbers of the longer studies, and what is published. Ranges here are wide: they tell an effect
from none, and a sign from the other one.
"""
import math
import tomllib
from dataclasses import dataclass
from pathlib import Path
from typing import Callable

from bed_states import coherence, over_the_cycle
from end_state import mean_of, share_of
from fields import Fields
from layer_pattern import Pattern
from rates import change, constant_of_hole, rate_kept

DRAFT = "run.accuracy=draft"


@dataclass
class Check:
    name: str
    claim: str
    scene: str  # of scenes/, without .toml
    control: list  # settings that switch the cause off
    what: str  # the number, in words
    number: Callable  # of the runs
    least: float = -math.inf
    most: float = math.inf
    runs: tuple = ((DRAFT,),)  # settings of each run

    def accepts(self, number):
        return self.least <= number <= self.most  # NaN is never accepted

    def expected(self):
        if math.isinf(self.least):
            return f"at most {self.most:.4g}"
        if math.isinf(self.most):
            return f"at least {self.least:.4g}"
        return f"{self.least:.4g} to {self.most:.4g}"


NARROW = ("container.width=120 mm", "species.grains.count=2000")  # half of the scene
SMALL_LAYER = ("container.width=60 mm", "container.depth=60 mm", "species.grains.count=12000", "output.trajectory=true")
SORT_AND_MIX = ('drive.stage=[{from="3 s", frequency="25 Hz", g_level=7, over=4},'
                ' {from="10 s", frequency="9 Hz", g_level=4, over=4}]')
FINE_ROWS = ("output.measures_interval=5 ms",)
UPRIGHT = ("container.half_angle=1 deg", "container.half_width=12 mm", "container.height=400 mm", "run.duration=1.5 s")
ON_EARTH = ("gravity=9.81", "drive.frequency=12 Hz", "run.duration=2 s", DRAFT)
ON_THE_MOON = ("run.duration=4.922 s", DRAFT)


def variant(study, name):
    """What a variant of a study of scenes/studies/controls sets."""
    file = Path(__file__).resolve().parents[2] / "scenes" / "studies" / "controls" / f"{study}.toml"
    variants = tomllib.loads(file.read_text(encoding="utf-8"))["variant"]
    return next(one["set"] for one in variants if one["name"] == name)


def height_in_diameters(run, after):
    """Mean height of the grains' centres above the floor; they have 2 mm."""
    return run.mean("grains_height", after) / 0.002


def highest_return(heights, radius):
    """Of a ball's centre above the floor: the highest point after the first impact, over the first one."""
    above = [height - radius for height in heights]
    impact = next(i for i in range(1, len(above) - 1) if above[i - 1] >= above[i] < above[i + 1])
    return max(above[impact:]) / above[0]


def along_walls(run, after, diameter):
    """Upward way of the grains beside left and right wall in a period, less that of all, in diameters."""
    return (run.mean("flow_left", after) + run.mean("flow_right", after)) / 2 / diameter


def discharge_time(run):
    """From the opening of the outlet until 99 % have run out."""
    return run.end("emptied") - 0.3


def hole_constant(run):
    """C of W = C rho_b sqrt(g) (D - 1.4 d)^2.5, with the density of a solid fraction of 0.6."""
    return constant_of_hole(change(run, "outflow", 0.25, 0.55), orifice=0.036, diameter=0.004, density=0.6 * 2500)


def small_lower_left(run):
    """Share of the small grains in the quarter of the drum that they leave first."""
    return share_of(run, lambda grain: grain["y"] < 0 and grain["z"] < 0, lambda grain: grain["type"] == 2)


def thrown_speed(throw, angle, frequency):
    """m/s along a trough that throws what lies on it, of a block that sticks where it lands.

    throw: peak acceleration across the trough over g, 1 to 3.3. The part n of a period that it flies follows from
    throw^2 = 1 + ((cos 2 pi n + 2 pi^2 n^2 - 1) / (2 pi n - sin 2 pi n))^2, which grows with n.
    """
    def needed(n):
        turn = 2 * math.pi * n
        return math.hypot(1, (math.cos(turn) + turn**2 / 2 - 1) / (turn - math.sin(turn)))

    low, high = 1e-3, 1.0
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if needed(middle) < throw else (low, middle)
    return 9.81 * low**2 / (2 * frequency * math.tan(angle))


def inverted_pattern(run):
    """Of a square box 60 mm wide: share of the surface, seen from above, that changes its sign every period."""
    return Pattern(Fields(run.folder / "trajectory.nc"), 0.06, 0.06).share


def drum_at(rate, seconds, **what):
    """A check of the drum of one size, which turns with `rate` rad/s."""
    return Check(scene="drum_mixing", runs=((f"run.duration={seconds} s", f"mesh[0].turn.rate={rate}", DRAFT),), **what)


CHECKS = [
    Check(
        name="convection_box",
        claim="a shaken bed sinks along rough vertical walls (Jaeger's page on convection)",
        scene="convection_box",
        runs=(("run.duration=2 s", DRAFT),),
        control=["contact.wall.friction=0"],
        what="flow along left and right wall, diameters a period",
        number=lambda run: along_walls(run, 0.8, 0.002),
        most=-0.15,
    ),
    Check(
        name="convection_wedge",
        claim="a shaken bed climbs along slanted walls (Jaeger's page on convection)",
        scene="convection_wedge",
        runs=(("run.duration=2.5 s", DRAFT),),
        control=["container.half_angle=1 deg"],
        what="flow along left and right slant, diameters a period",
        number=lambda run: along_walls(run, 1, 0.005),
        least=0.015,
    ),
    Check(
        name="heap",
        claim="a low heap stands between rough walls near 1.2 g",
        scene="heaping",
        runs=(("run.duration=2.5 s", DRAFT),),
        control=["contact.wall.friction=0"],
        what="surface in the middle less that at the walls, diameters",
        number=lambda run: run.mean("mound_height", 1.5) / 0.002,
        least=0.3,
    ),
    Check(
        name="arching",
        claim="a layer that is thrown high stands in arches (J. Phys. Soc. Jpn. 72, 1390)",
        scene="arching",
        runs=(("run.duration=0.8 s", DRAFT),),
        control=variant("arching", "seeds, Γ = 2.5"),
        what="root mean square height of the surface, diameters",
        number=lambda run: run.mean("surface_rms", 0.4) / 0.002,
        least=0.7,
    ),
    Check(
        name="shallow_bed_coherent",
        claim="a bed of ten diameters moves as one mass, one of half a diameter does not (the thesis)",
        scene="shallow_bed",
        runs=(("species.0.count=1160", "run.duration=2 s", DRAFT),),
        control=["species.0.count=58"],
        what="share of the kinetic energy that is in the motion of the centre of mass",
        number=lambda run: coherence(run, 1),
        least=0.5,
    ),
    Check(
        name="shallow_bed_expands",
        claim="a bed of four diameters moves as one mass that expands, a deeper one stays dense (the thesis)",
        scene="shallow_bed",
        runs=(("species.0.count=464", "run.duration=2 s", DRAFT),),
        control=["species.0.count=1740"],
        what="least solid fraction over the cycle",
        number=lambda run: min(over_the_cycle(run, "bed_solid_fraction", 1)),
        most=0.35,
    ),
    Check(
        name="bed_takes_off",
        claim="the floor bears less than a tenth of a bed from sin(2 pi p) = 0.9/Gamma on, as of a block",
        scene="bed_flight",
        runs=(("drive.g_level=1.5", DRAFT),),
        control=["drive.g_level=0.9"],
        what="phase p, turns; a block has 0.1024",
        number=lambda run: run.mean("takeoff_turns", 1),
        least=0.097,
        most=0.107,
    ),
    Check(
        name="period_doubles",
        claim="above Gamma = 3.72 a bed repeats itself every second period",
        scene="bed_flight",
        runs=(("drive.g_level=4.5", DRAFT),),
        control=["drive.g_level=2.5"],
        what="periods after which it repeats itself",
        number=lambda run: run.end("bed_periods"),
        least=2,
        most=2,
    ),
    Check(
        name="intruder_rises",
        claim="one large grain comes up between rough walls (Knight, Jaeger & Nagel 1993)",
        scene="intruder_rise",
        control=variant("intruder_rise", "seeds, no friction"),
        what="time until it is at the surface, s",
        number=lambda run: run.end("rise_time"),
        most=6,
    ),
    Check(
        name="surface_waves",
        claim="peaks and valleys change places every period (Melo, Umbanhowar & Swinney 1994)",
        scene="surface_waves",
        control=variant("surface_waves", "seeds, Γ = 1.5"),
        what="share of the surface that is inverted every period; by chance 0.125",
        number=lambda run: run.mean("surface_half", 1.5),
        least=0.5,
        runs=((*NARROW, DRAFT),),
    ),
    Check(
        name="layer_patterns",
        claim="a wide layer stands in a pattern that changes places every period (Umbanhowar, Melo & Swinney 1998)",
        scene="layer_patterns",
        runs=((*SMALL_LAYER, "drive.frequency=15.5 Hz", "run.duration=1.62 s"),),
        control=["drive.g_level=2"],
        what="share of the surface, seen from above, that is inverted every period; by chance 0.125",
        number=inverted_pattern,
        least=0.25,
    ),
    Check(
        name="quarter_waves",
        claim="harder shaking makes waves that come back every fourth period (Umbanhowar & Swinney 2000: from Gamma = 5.5)",
        scene="surface_waves",
        control=["drive.g_level=3"],
        what="share of the surface that is inverted after two periods; by chance 0.25",
        number=lambda run: run.mean("surface_quarter", 1.5),
        least=0.4,
        runs=((*NARROW, "drive.g_level=6", "drive.frequency=22 Hz", DRAFT),),
    ),
    Check(
        name="wedge_segregation",
        claim="in the default film the big grains end on top, and walls without friction do not bring them there",
        scene="wedge_segregation",
        control=["contact.wall.friction=0"],
        what="height of big over small grains in the last second, over the bed's height",
        number=lambda run: run.mean("height_difference", 10),
        least=0.1,
    ),
    Check(
        name="wedge_size",
        claim="in the default film size alone keeps the big grains on top: of one size, the roll mixes them",
        scene="wedge_segregation",
        control=variant("wedge_segregation", "equal sizes"),
        what="height of the grains that began below over the others, 20 to 22 s, over the bed's height",
        number=lambda run: run.mean("height_difference", 20),
        least=0.1,
        runs=(("run.duration=22 s", DRAFT),),
    ),
    Check(
        name="wedge_mixture",
        claim="shaking above Gamma = 1 brings the big grains of a mixture in a sealed wedge up",
        scene="wedge_mixture",
        control=variant("wedge_mixture", "seeds, Γ = 1.2"),
        what="height of big over small grains from 6 to 7 s, over the bed's height",
        number=lambda run: run.mean("height_difference", 6),
        least=0.0,
        runs=(("run.duration=7 s", DRAFT),),
    ),
    Check(
        name="wedge_mixture_size",
        claim="in the sealed wedge size keeps the big grains of a mixture above the small ones: of one size, the roll mixes them",
        scene="wedge_mixture",
        control=variant("wedge_mixture", "equal sizes"),
        what="height of the grains that began below over the others, 12 to 15 s, over the bed's height",
        number=lambda run: run.mean("height_difference", 12),
        least=0.08,
        runs=(("run.duration=15 s", "run.precision=mixed", DRAFT),),
    ),
    Check(
        name="hopper_rate",
        claim="vertical shaking slows the discharge of a wedge hopper (Wassgren et al. 2002)",
        scene="hopper_mixture",
        control=["drive.g_level=0.01"],
        what="time to run out when shaken with Gamma = 8 over that at rest",
        number=lambda shaken, rest: discharge_time(shaken) / discharge_time(rest),
        least=1.08,
        runs=tuple((f"drive.g_level={g}", "run.duration=1.3 s", "run.precision=mixed", DRAFT) for g in (8, 0.01)),
    ),
    Check(
        name="void_filling",
        claim="big grains rise between walls without friction too (void filling or the bed's own roll)",
        scene="void_filling",
        control=variant("void_filling", "asleep"),
        what="height of big over small grains from 4 to 5 s, over the bed's height",
        number=lambda run: run.mean("height_difference", 4),
        least=-0.34,
        runs=(("run.duration=5 s", DRAFT),),
    ),
    Check(
        name="reversal",
        claim="9 Hz at Gamma = 4 stirs again what 25 Hz at Gamma = 7 has sorted (compare Brone & Muzzio 1997)",
        scene="frequency_reversal",
        control=["drive.stage=[]"],
        what="height of big over small grains, sorted from 9 to 10 s less mixed again from 14 to 15 s",
        number=lambda run: run.mean("height_difference", 9, 10) - run.mean("height_difference", 14, 15),
        least=0.06,
        runs=(("run.duration=15 s", SORT_AND_MIX, "run.precision=mixed", DRAFT),),
    ),
    Check(
        name="gravity_scales_out",
        claim="at equal Gamma and f sqrt(d/g) a bed on the Moon does what it does on Earth",
        scene="reduced_gravity",
        runs=(ON_EARTH, ON_THE_MOON),
        control=["drive.frequency=12 Hz", "drive.amplitude=5.18 mm"],
        what="height of the grains on the Moon over that on Earth, in diameters",
        number=lambda earth, moon: height_in_diameters(moon, 2.46) / height_in_diameters(earth, 1),
        least=0.95,
        most=1.05,
    ),
    Check(
        name="janssen",
        claim="the walls of a silo carry part of its filling (Janssen 1895)",
        scene="janssen",
        control=["contact.wall.friction=0"],
        what="share of the weight on the floor",
        number=lambda run: run.mean("floor_carries", 0.2),
        least=0.45,
        most=0.7,
    ),
    Check(
        name="heap_of_repose",
        claim="grains that are poured stand in a heap, held by friction",
        scene="poured_heap",
        control=["contact.friction=0", "contact.rolling_friction=0"],
        what="tangent of the heap's slope",
        number=lambda run: run.end("mound_slope"),
        least=0.15,
        most=0.7,
        runs=(('output.instruments=["surface"]', DRAFT),),
    ),
    Check(
        name="bouncing_ball",
        claim="a hardly elastic ball on a plate doubles its period above Gamma = 3.72 (Holmes 1982)",
        scene="teaching_strobe",
        runs=(("output.measures_interval=0.125 s",),),
        control=["drive.g_level=2"],
        what="difference of height from one period to the next, at one phase, in diameters of the ball",
        number=lambda run: abs(run.values("ball_height")[-1] - run.values("ball_height")[-2]) / 0.03,
        least=0.3,
    ),
    Check(
        name="restitution",
        claim="a ball whose restitution is e comes back to e^2 of its height",
        scene="teaching_restitution",
        control=["contact.pair[1].restitution=0.4"],
        what="height of the first return over that of the drop, e = 0.7",
        number=lambda run: highest_return(run.values("e = 0.7_height"), radius=0.006),
        least=0.485,
        most=0.495,
        runs=((),),
    ),
    Check(
        name="rolling",
        claim="down a slope a ball that rolls has 5/7 = 0.714 of the way of one that slides",
        scene="teaching_friction_and_rolling",
        control=["contact.friction=0"],
        what="way of the rolling ball over that of the sliding one",
        number=lambda run: (run.end("friction_centre_y") + 0.18) / (run.end("no friction_centre_y") + 0.18),
        least=0.712,
        most=0.716,
        runs=((),),
    ),
    Check(
        name="row_of_balls",
        claim="five impacts in a row pass on ((1 + e)/2)^10 = 0.951 of the energy at e = 0.99",
        scene="teaching_row_of_balls",
        control=["contact.restitution=0.7"],
        what="kinetic energy after them over that before",
        number=lambda run: run.values("kinetic", 0.3)[0] / run.values("kinetic")[0],
        least=0.945,
        most=0.957,
        runs=((),),
    ),
    Check(
        name="hourglass",
        claim="grains run out at one rate however high they stand, for friction carries them (Beverloo et al. 1961)",
        scene="teaching_hourglass",
        control=["contact.friction=0"],
        what="rate near the end over that near the beginning, of the hourglass and of an upright column, the smaller one",
        number=lambda *runs: min(rate_kept(run) for run in runs),
        least=0.75,
        most=1.3,
        runs=(FINE_ROWS, FINE_ROWS + UPRIGHT),
    ),
    Check(
        name="thrown_bed",
        claim="below Gamma = 1 a bed goes with the floor, at Gamma = 3 it is thrown",
        scene="teaching_changing_drive",
        control=['drive.stage=[{from="0.9 s", frequency="15 Hz", g_level=0.9}]'],
        what="highest mean height of the small grains above the floor at Gamma = 3 less that at 0.8, diameters",
        number=lambda run: (max(run.values("small_height", 1.3, 2.6)) - max(run.values("small_height", 0.3, 0.9))) / 0.006,
        least=0.3,
    ),
    Check(
        name="brazil_nut",
        claim="a large grain comes up between rough walls (Knight, Jaeger & Nagel 1993)",
        scene="teaching_brazil_nut",
        control=["drive.g_level=0.9"],
        what="level of the nut in the bed from 3.5 to 4.5 s, 1 is the surface",
        number=lambda run: run.mean("intruder_level", 3.5),
        least=0.7,
        runs=(('output.instruments=["intruder"]', DRAFT),),
    ),
    Check(
        name="gas_cools",
        claim="a gas of grains that is left alone cools",
        scene="teaching_gas_cooling",
        control=["contact.restitution=1"],
        what="kinetic energy at 3 s over that at 1.5 s",
        number=lambda run: run.end("kinetic") / run.values("kinetic", 1.5)[0],
        most=0.3,
    ),
    Check(
        name="sorting",
        claim="shaking above Gamma = 1 brings big grains up",
        scene="teaching_sorting",
        control=["drive.stage.0.g_level=0.8"],
        what="share of the big grains in the bed's top quarter at the end",
        number=lambda run: run.end("big_in_top_quarter"),
        least=0.5,
    ),
    Check(
        name="cone_hopper",
        claim="a cone empties at C rho sqrt(g) (D - 1.4 d)^2.5 with C of 0.55 to 0.65 (Beverloo et al. 1961, Nedderman 1992)",
        scene="cone_hopper",
        runs=((DRAFT, "run.duration=0.6 s"),),
        control=["contact.friction=0", "contact.wall.friction=0"],
        what="C from 0.25 to 0.55 s",
        number=hole_constant,
        least=0.55,
        most=0.65,
    ),
    Check(
        name="drum",
        claim="in the first half turn a bed slides over in a drum: after 1 s two codes have 0.33 of the small grains in the"
        " lower left quarter (Dosta et al. 2024), within 5 % of the grains",
        scene="drum",
        runs=(("run.duration=1 s",),),
        control=["contact.wall.friction=0"],
        what="share of the small grains in the lower left quarter after 1 s",
        number=small_lower_left,
        least=0.28,
        most=0.38,
    ),
    drum_at(
        0.99,
        name="drum_rolls",
        claim="at a Froude number of 0.005 a bed rolls: its surface stands at the dynamic angle of repose (Mellmann 2001)",
        seconds=1.8,
        control=["contact.friction=0"],
        what="dynamic angle of repose from 1.2 to 1.8 s, degrees",
        number=lambda run: run.mean("repose_angle_degree", 1.2),
        least=20,
        most=45,
    ),
    drum_at(
        20,
        name="drum_centrifuges",
        claim="at a Froude number of 2 all grains stay at the drum's wall (Mellmann 2001: from 1 on)",
        seconds=0.9,
        control=["mesh[0].turn.rate=3.13"],
        what="distance of the centre of mass from the axis over the drum's radius, 0.7 to 0.9 s",
        number=lambda run: math.hypot(run.mean("centre_y", 0.7), run.mean("centre_z", 0.7)) / 0.05,
        most=0.2,
    ),
    drum_at(
        2.5,
        name="drum_mixes",
        claim="two turns of a drum bring grains of one size more than half way to a random mixture",
        seconds=5,
        control=["mesh[0].turn.rate=0.1"],
        what="Lacey's index from 4.5 to 5 s",
        number=lambda run: run.mean("lacey", 4.5),
        least=0.5,
    ),
    Check(
        name="drum_lifters",
        claim="bars along a drum's wall lift grains above the height at which a slope of 35 degrees ends without them",
        scene="drum_lifters",
        runs=(("run.duration=1.5 s", DRAFT),),
        control=["mesh[0].file=shipped:drum.stl"],
        what="share of the grains higher than 0.3 radii above the axis",
        number=lambda run: share_of(run, lambda grain: grain["z"] > 0.03),
        least=0.01,
    ),
    Check(
        name="screw",
        claim="a screw pushes grains along, one pitch a turn at most; 0.77 of it where they go round with the blade as far as"
        " friction allows, 1/(1 + tan a tan(a + arctan mu)) with the helix angle a at 16 mm (Roberts 1999)",
        scene="screw_conveyor",
        runs=(("run.duration=2.5 s", DRAFT),),
        control=["mesh[1].turn.rate=-0.01"],
        what="speed of the grains in the middle of the trough over pitch times turns a second",
        number=lambda run: mean_of(run, "vy", lambda grain: -0.04 < grain["y"] < 0.06) / 0.08,
        least=0.7,
        most=1.05,
    ),
    Check(
        name="conveyor",
        claim="a trough that throws conveys as a block that sticks where it lands: g n^2 / (2 f tan b)",
        scene="conveyor",
        runs=(("run.duration=0.8 s", DRAFT),),
        control=["drive.direction=[0, 0, 1]"],
        what="speed of the grains from 0.3 to 0.8 s over that of the block, 0.25 m/s",
        number=lambda run: change(run, "centre_y", 0.3, 0.8) / thrown_speed(2.5, math.radians(30), 25),
        least=0.8,
        most=1.1,
    ),
]
