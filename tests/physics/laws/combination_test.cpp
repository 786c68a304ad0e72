// Tests that every combination of law, friction, rolling, integrator, precision and container runs soundly,
// or is refused with a reason.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "engine/base/error.hpp"
#include "engine/run/simulation/simulated_bed.hpp"
#include "engine/scene/chapters/words.hpp"
#include "engine/scene/scene_file.hpp"

namespace grainreel {
namespace {

const std::vector<std::string> normal_laws = {
    "law = \"walton-braun\"",
    "law = \"walton-braun\"\nrestitution_speed = \"1 m/s\"",
    "law = \"walton-braun\"\nrestitution_table = [[0, 0.9], [1, 0.5]]",
    "law = \"spring-dashpot\"",
    "law = \"spring-dashpot\"\nattraction = true",
    "law = \"hertz\"\nattraction = true",
    "law = \"hertz\""};
const std::vector<std::string> containers = {
    "shape = \"box\"\nwidth = 0.02\ndepth = 0.02\nheight = 0.04\n",
    "shape = \"box\"\nwidth = 0.02\ndepth = 0.02\nheight = 0.04\nperiodic_depth = true\n",
    "shape = \"wedge\"\nhalf_width = 0.01\nhalf_angle = \"10 deg\"\nslant_height = 0.02\ndepth = 0.02\n"
    "height = 0.04\n",
    "shape = \"cylinder\"\ndiameter = 0.02\nheight = 0.04\n",
    "shape = \"none\"\n[[wall]]\npoint = [0, 0, 0]\nnormal = [0, 0.2, 1]\n"};

// A small, fast crowd. Its grains nearly touch, and hit each other and the floor within its 2 ms.
std::string crowd(const std::string& law, const std::string& friction, bool rolls,
                  const std::string& container) {
    std::string text = fmt::format(
        "gravity = 10\n[[species]]\nname = \"a\"\ndiameter = \"3 mm\"\ndensity = 2500\n[contact]\n{}\n"
        "friction_law = \"{}\"\n{}{}[container]\n{}[start]\nmethod = \"grains\"\n",
        law, friction, friction == "none" ? "" : "friction = 0.5\n", rolls ? "rolling_friction = 0.1\n" : "",
        container);
    for (int k = 0; k < 8; ++k)
        text +=
            fmt::format("[[grain]]\nposition = [{}, {}, {}]\nvelocity = [{}, {}, -0.5]\nspin = [{}, 30, 0]\n",
                        0.00301 * (k % 2) - 0.0015, 0.00301 * (k / 2 % 2) - 0.0014,
                        0.00301 * (k / 4) + 0.0019, 0.3 - 0.7 * (k % 2), 0.1 * (k % 3), 20 * k);
    return text + "[run]\nduration = 0.002\n";
}

double energy(const Measures& m) {
    return m.at("kinetic_J") + m.at("rotational_J") + m.at("gravitational_J") + m.at("elastic_J");
}

// The message of a scene that is refused, or "" after a sound run, in which no grain is lost and no energy
// appears.
std::string run(const std::string& text, const std::vector<std::string>& sets) {
    Scene scene;
    try {
        scene = read_scene_text(text, "test.toml", sets);
    } catch (const UserError& refused) {
        return refused.what();
    }
    const Plan plan = make_plan(scene);
    SimulatedBed simulation(scene, plan, 1);
    simulation.pack();
    const double before = energy(simulation.measures());
    simulation.advance(plan.steps);
    const Measures after = simulation.measures();
    EXPECT_TRUE(std::isfinite(energy(after)));
    EXPECT_LT(energy(after), 1.001 * before);
    EXPECT_LT(energy(after), 0.95 * before) << "nothing collided";
    return "";
}

bool go_together(const std::string& law, const std::string& friction) {
    const bool hertz = law.find("hertz") != std::string::npos;
    return friction == "none" || hertz == (friction == "mindlin");
}

// The plan of repelling Hertz integrates hundreds of impacts to find its dashpot. The rest of it is as with
// attraction. So each integrator runs in one container, and each container with one integrator.
bool left_out(const std::string& law, const std::string& container, const std::string& integrator) {
    return law == "law = \"hertz\"" && container != containers[0] &&
           integrator != all_of(integrator_words).front();
}

TEST(Combinations, RunOrAreRefusedWithAReason) {
    int ran = 0, refused = 0;
    for (const std::string& law : normal_laws) {
        for (const std::string& friction : all_of(tangential_law_words)) {
            for (const bool rolls : {false, true}) {
                for (const std::string& container : containers) {
                    const std::string text = crowd(law, friction, rolls, container);
                    for (const std::string& integrator : all_of(integrator_words)) {
                        if (left_out(law, container, integrator)) continue;
                        for (const std::string& precision : all_of(precision_words)) {
                            SCOPED_TRACE(fmt::format("{} / {} / rolls {} / {} / {} / {}", law, friction,
                                                     rolls, container.substr(0, 16), integrator, precision));
                            const std::string said =
                                run(text, {"run.integrator=" + integrator, "run.precision=" + precision});
                            const bool sound = go_together(law, friction) && !(rolls && friction == "none");
                            EXPECT_EQ(said == "", sound) << said;
                            EXPECT_EQ(said.find(';') != std::string::npos, !sound) << "no remedy";
                            ++(said == "" ? ran : refused);
                        }
                    }
                }
            }
        }
    }
    // Five of the 7 laws go with 2 kinds of friction and 2 laws with one, rolling or not, and each law goes
    // without friction; in 5 containers with 5 integrators in 2 precisions. The 4 x 4 that repelling Hertz
    // leaves out are subtracted.
    EXPECT_EQ(ran, ((5 * 2 + 2 * 1) * 2 + 7) * 5 * 5 * 2 - (2 + 1) * 4 * 4 * 2);
    EXPECT_EQ(ran + refused, 7 * 4 * 2 * 5 * 5 * 2 - 4 * 2 * 4 * 4 * 2);
}

}  // namespace
}  // namespace grainreel
