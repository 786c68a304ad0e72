// Converts between the public types of the library, in grainreel::v1, and those of the program, in grainreel.
// Only the library's sources include this header, before any public header: the macro below keeps the names
// of v1 out of grainreel.
#pragma once

#ifndef GRAINREEL_LIBRARY_SOURCE
#define GRAINREEL_LIBRARY_SOURCE
#endif

#include <exception>
#include <filesystem>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/base/vector.hpp"
#include "engine/files/frames/state_archive.hpp"
#include "engine/files/frames/stored_world.hpp"
#include "engine/laws/law_kernel.hpp"
#include "engine/plan/plan.hpp"
#include "engine/run/stored/stored_run.hpp"
#include "engine/scene/scene.hpp"
#include "engine/state/state.hpp"
#include "grainreel/contact_law.hpp"
#include "grainreel/error.hpp"
#include "grainreel/files.hpp"
#include "grainreel/frame.hpp"
#include "grainreel/scene.hpp"
#include "grainreel/world.hpp"

namespace grainreel::v1 {

// The program's message with the words of the library in place of options of the command line: "setting
// film.size" for "--set film.size". Options of which the library has none stay.
std::string in_words_of_library(std::string message);

// Calls a function of the program and turns its errors into those of the library.
template <class Call>
auto told(const Call& call) -> decltype(call()) {
    try {
        return call();
    } catch (const UserError& error) {
        throw Error(in_words_of_library(error.what()), Error::Kind::mistake);
    } catch (const RunError& error) {
        throw Error(in_words_of_library(error.what()), Error::Kind::failure);
    } catch (const std::filesystem::filesystem_error& error) {
        throw Error(error.what(), Error::Kind::failure);
    }
}

// inside() makes a value of the program from a public one, outside() a public one from that of the program.
Vec3 inside(const Vector& v);
Vector outside(const Vec3& v);
Quaternion inside(const Rotation& r);
Rotation outside(const Quaternion& q);

Frame outside(const grainreel::State& frame);
// Throws Error where lists differ in length, ids do not rise, a number is not finite or a species is not less
// than `species`. who: the beginning of the message.
grainreel::State inside(const Frame& frame, std::size_t species, const std::string& who);

// Gives a frame of the caller as many poses as its world has bodies; further ones are not used. given: how
// many the caller gave. Throws Error where these are some but not all.
void take_poses(grainreel::State& frame, std::size_t given, std::size_t bodies, const std::string& who);
// Throws Error where the time, the cycles or a pose is no number, or one that no run can have. A time of NaN,
// which is not known, passes.
void check_moment(const grainreel::State& frame, const std::string& who);

World outside(const grainreel::StoredWorld& world);
grainreel::StoredWorld inside(const World& world);

// Throws Error where a number of threads is none that a scene file may have in run.threads.
void check_threads(int threads);

// A scene that was read, how it was read, and its plan.
struct Scene::Impl {
    grainreel::Scene scene;
    Plan plan;
    std::string text;            // the text of the scene's file
    std::filesystem::path file;  // the file's name
    std::vector<std::string> settings;
};

struct FrameFile::Impl {
    std::unique_ptr<StoredRun> archive;
};

// A caller's contact law in the form that the step loop can run: a LawKernel that calls the law for one
// contact after the other. An OwnLaw must outlive all loops that run it.
class OwnLaw {
  public:
    // Throws Error where the law is null, or wants to keep more numbers for a contact than it may. `name` is
    // its name in messages.
    OwnLaw(std::shared_ptr<const ContactLaw> law, std::string name);
    OwnLaw(const OwnLaw&) = delete;
    OwnLaw& operator=(const OwnLaw&) = delete;

    const LawKernel& kernel() const { return kernel_; }
    // Throws the first exception that the law has thrown, on any thread, since the last call of this
    // function. A force that is no number counts as an Error.
    void rethrow();

  private:
    struct Kernel : LawKernel {
        OwnLaw* own = nullptr;
    };
    static OwnLaw& of(const LawParameters& parameters);
    static LawParameters parameters_of(const std::vector<PairPlan>& kinds);
    static void step(const LawInput& in, void* history, ForceChunk& out);
    static void step_one_kind(const LawInput& in, void* history, ForceChunk& out);
    static void observe(const LawInput& in, const void* history, ForceChunk& out, EnergyChunk& energy);
    static void step_kinds(const LawInput& in, double* history, ForceChunk& out, bool one_kind);
    void note(std::exception_ptr thrown);
    void check(const ContactForce& force, const Touch& touch) const;

    std::shared_ptr<const ContactLaw> law_;
    std::string name_;
    int numbers_ = 0, vectors_ = 0;
    Kernel kernel_;
    std::mutex guard_;
    std::exception_ptr thrown_;
};

}  // namespace grainreel::v1
