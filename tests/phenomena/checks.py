"""The quick form of each phenomenon: one number, the range in which it must lie, and the control. See check.py.

docs/phenomena.md has the numbers of the longer studies, and what is published. Ranges here are wide: they tell an effect
from none, and a sign from the other one.
"""
import math
from dataclasses import dataclass
from typing import Callable

from bed_states import coherence, over_the_cycle

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


ON_EARTH = ("gravity=9.81", "drive.frequency=12 Hz", "run.duration=2 s", DRAFT)
ON_THE_MOON = ("run.duration=4.922 s", DRAFT)


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


CHECKS = [
    Check(
        name="convection_box",
        claim="a shaken bed sinks along rough vertical walls (Knight et al. 1996)",
        scene="convection_box",
        runs=(("run.duration=2 s", DRAFT),),
        control=["contact.wall.friction=0"],
        what="flow along left and right wall, diameters a period",
        number=lambda run: along_walls(run, 0.8, 0.002),
        most=-0.15,
    ),
    Check(
        name="convection_wedge",
        claim="a shaken bed climbs along slanted walls (Knight, Jaeger & Nagel 1993)",
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
        control=["drive.g_level=2.5"],
        what="root mean square height of the surface, diameters",
        number=lambda run: run.mean("surface_rms", 0.4) / 0.002,
        least=0.7,
    ),
    Check(
        name="shallow_bed_coherent",
        claim="a bed of ten diameters moves as one mass, one of half a diameter does not (Thomas et al. 1989)",
        scene="shallow_bed",
        runs=(("species.0.count=1160", "run.duration=2 s", DRAFT),),
        control=["species.0.count=58"],
        what="share of the kinetic energy that is in the motion of the centre of mass",
        number=lambda run: coherence(run, 1),
        least=0.5,
    ),
    Check(
        name="shallow_bed_expands",
        claim="a bed of four diameters moves as one mass that expands, a deeper one stays dense (Thomas et al. 1989)",
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
        control=["contact.wall.friction=0"],
        what="time until it is at the surface, s",
        number=lambda run: run.end("rise_time"),
        most=6,
    ),
    Check(
        name="surface_waves",
        claim="peaks and valleys change places every period (Melo, Umbanhowar & Swinney 1994)",
        scene="surface_waves",
        control=["drive.g_level=1.5"],
        what="share of the surface that is inverted every period; by chance 0.125",
        number=lambda run: run.mean("surface_half", 1.5),
        least=0.5,
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
]
