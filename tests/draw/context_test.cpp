// Tests of contexts from OSMesa and EGL (from EGL alone where Mesa has no OSMesa any more): they draw alike
// and work side by side on one thread, and their table has only functions of OpenGL 3.3.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <fstream>
#include <map>
#include <memory>
#include <random>
#include <sstream>

#include "engine/base/error.hpp"
#include "render/picture/gl/opengl.hpp"
#include "render/scene/filmed_scene.hpp"
#include "tests/draw/support.hpp"

namespace grainreel::test {
namespace {

using gl::EglPlatform, gl::Provider;

State heap() {
    std::mt19937 random(11);
    const auto between = [&](double a, double b) {
        return a + (b - a) * static_cast<double>(random()) / 4294967296.0;
    };
    std::vector<Ball> balls;
    for (int i = 0; i < 400; ++i)
        balls.push_back({{between(-0.015, 0.015), between(-0.04, 0.04), between(0.01, 0.12)},
                         i % 9 ? 0.0025 : 0.006,
                         i % 9 ? 0 : 1});
    return frame_of(balls);
}

// Share of the pixels whose channels all differ by at most `least`.
double alike(const Picture& a, const Picture& b, int least) {
    std::size_t same = 0;
    for (std::size_t i = 0; i < a.rgba.size(); i += 4) {
        int worst = 0;
        for (std::size_t c = 0; c < 4; ++c)
            worst = std::max(worst, std::abs(int{a.rgba[i + c]} - int{b.rgba[i + c]}));
        same += worst <= least;
    }
    return static_cast<double>(same) / (0.25 * static_cast<double>(a.rgba.size()));
}

// OSMesa crashed where the environment named a driver of another kind, as it does in WSL.
TEST(Context, DriversThatTheEnvironmentNamesDoNotMatter) {
    setenv("GALLIUM_DRIVER", "d3d12", 1);
    setenv("MESA_GL_VERSION_OVERRIDE", "3.0", 1);
    setenv("MESA_GLSL_VERSION_OVERRIDE", "110", 1);
    Renderer renderer(wedge(320, 180), 1, Provider::automatic);
    EXPECT_THAT(renderer.gl_description(), testing::HasSubstr("llvmpipe"));
}

TEST(Context, EglDrawsWhatOSMesaDraws) {
    for (const auto shape : {Container::Shape::wedge, Container::Shape::cylinder}) {
        FilmedScene scene = wedge(960, 540);
        scene.container.shape = shape;
        Renderer osmesa(scene, 1, Provider::automatic), egl(scene, 1, Provider::egl);
        const Picture reference = osmesa.draw(heap(), "a caption");
        const Picture& picture = egl.draw(heap(), "a caption");
        EXPECT_GE(alike(reference, picture, 2), 0.999);
        EXPECT_LT(alike(reference, osmesa.draw(frame_of({}), "a caption"), 2),
                  0.99);  // the comparison can tell pictures apart
    }
}

// The colour that a context of its own leaves in a framebuffer.
std::array<std::uint8_t, 4> cleared(gl::Context& context, const gl::Framebuffer& target, float red) {
    context.make_current();
    target.bind();
    const std::array<float, 4> colour{red, 0.25f, 0.5f, 1.0f};
    context.gl().ClearBufferfv(GL_COLOR, 0, colour.data());
    std::array<std::uint8_t, 4> pixel{};
    context.gl().ReadPixels(7, 7, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, pixel.data());
    return pixel;
}

TEST(Context, SeveralOnOneThreadKeepApart) {
    constexpr gl::TextureFormat bytes{GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE};
    std::vector<std::unique_ptr<gl::Context>> contexts;
    std::vector<std::unique_ptr<gl::Framebuffer>> targets;
    contexts.push_back(gl::make_context(Provider::automatic, 1));
    contexts.push_back(gl::make_egl_context(1, {EglPlatform::device}));
    contexts.push_back(gl::make_context(Provider::automatic, 1));
    contexts.push_back(gl::make_egl_context(1, {EglPlatform::surfaceless}));
    for (const auto& context : contexts) {
        context->make_current();
        targets.push_back(std::make_unique<gl::Framebuffer>(context->gl(), 16, 16, bytes));
    }
    for (const std::size_t k : {0u, 1u, 2u, 3u, 0u, 3u, 1u, 2u, 1u})
        EXPECT_THAT(cleared(*contexts[k], *targets[k], 0.2f * static_cast<float>(k)),
                    testing::ElementsAre(51 * k, testing::AnyOf(63, 64), testing::AnyOf(127, 128), 255));
    targets[1].reset();
    contexts[1].reset();
    EXPECT_EQ(cleared(*contexts[2], *targets[2], 1.0f)[0], 255);
    for (std::size_t k = 0; k < contexts.size(); ++k) {
        if (contexts[k]) contexts[k]->make_current();
        targets[k].reset();
    }
}

TEST(Context, ARendererThatTakesTheOneOfAnotherDrawsTheSame) {
    FilmedScene other = wedge();
    other.film.width += 64;
    other.film.camera.azimuth = 40;
    const Picture alone = Renderer(other, 1).draw(heap(), "");
    auto first = std::make_unique<Renderer>(wedge(), 1);
    const Picture before = first->draw(heap(), "");
    Renderer second(other, 1, Provider::automatic, first->context());
    Renderer stranger(wedge(), 1);  // has a context of its own, which is current
    EXPECT_EQ(second.draw(heap(), "").rgba, alone.rgba);
    EXPECT_EQ(first->draw(heap(), "").rgba, before.rgba);
    EXPECT_EQ(first->context(), second.context());
    EXPECT_NE(first->context(), stranger.context());
    stranger.draw(frame_of({}), "");
    first.reset();
    EXPECT_EQ(second.draw(heap(), "").rgba, alone.rgba);
}

TEST(Context, TwoRenderersTakeTurns) {
    Renderer one(wedge(), 1, Provider::automatic), two(wedge(), 1, Provider::egl);
    const Picture first = one.draw(heap(), ""), second = two.draw(frame_of({}), "");
    EXPECT_EQ(one.draw(heap(), "").rgba, first.rgba);
    EXPECT_EQ(two.draw(frame_of({}), "").rgba, second.rgba);
}

TEST(Context, ARendererThatGoesTakesNothingFromTheOneInUse) {
    auto gone = std::make_unique<Renderer>(wedge(), 1, Provider::automatic);
    Renderer one(wedge(), 1, Provider::automatic), other(wedge(), 1, Provider::automatic);
    gone->draw(heap(), "");
    State moved = heap();
    moved.container().place = {0, 0, 0.03};
    const Picture expected = other.draw(moved, "");
    one.draw(heap(), "");
    gone.reset();
    EXPECT_EQ(one.draw(moved, "").rgba, expected.rgba);
}

// eglGetProcAddress and OSMesaGetProcAddress return pointers for invented names too, so a pointer proves
// nothing. Therefore every function in the table must belong to OpenGL 3.3, which the context has.
TEST(Context, TheTableHoldsNothingNewerThanOpenGL33) {
    std::ifstream header(GLCORE_HEADER);
    ASSERT_TRUE(header) << GLCORE_HEADER;
    std::map<std::string, std::string> version_of;
    std::string version;
    for (std::string line; std::getline(header, line);) {
        std::istringstream words(line);
        std::string word;
        words >> word;
        if (word == "#ifndef") words >> version;  // GL_VERSION_3_3, or an extension's name
        const std::size_t name = line.find("GLAPI ");
        if (name == 0) {
            const std::size_t call = line.find("APIENTRY ") + 9;
            version_of[line.substr(call, line.find(' ', call) - call)] = version;
        }
    }
    ASSERT_EQ(version_of["glDispatchCompute"], "GL_VERSION_4_3");
#define GRAINREEL_GL_NAME(type, name) "gl" #name,
    for (const std::string name : {GRAINREEL_GL_FUNCTIONS(GRAINREEL_GL_NAME)}) {
        ASSERT_TRUE(version_of.count(name)) << name;
        EXPECT_THAT(version_of[name], testing::StartsWith("GL_VERSION_")) << name;
        EXPECT_LE(version_of[name], "GL_VERSION_3_3") << name;
    }
#undef GRAINREEL_GL_NAME
}

TEST(Context, SaysWhoMadeIt) {
    EXPECT_THAT(Renderer(wedge(), 1).gl_description(),
                testing::AllOf(testing::AnyOf(testing::StartsWith("OSMesa: "), testing::StartsWith("EGL: ")),
                               testing::HasSubstr("llvmpipe"), testing::HasSubstr("OpenGL")));
    EXPECT_THAT(Renderer(wedge(), 1, Provider::egl).gl_description(), testing::StartsWith("EGL: "));
    EXPECT_EQ(Renderer(wedge(), 1).gl_note(), "");
}

}  // namespace
}  // namespace grainreel::test
