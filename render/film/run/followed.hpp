// What `render --follow` draws: frames of another program that are filed in the folder of a run while they
// come. They come from files that another program writes, or from the job of a scene that was handed over.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "engine/files/frames/state_archive.hpp"
#include "engine/plan/plan.hpp"
#include "engine/run/folder/listener.hpp"
#include "engine/scene/keys/keys.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

struct FollowRequest {
    std::filesystem::path from;  // a file, a pattern, a folder; or the folder of a hand-over
    ReadingOptions reading{};
    Assignments sets{};            // values given to keys of the film
    std::filesystem::path beside;  // the folder in which the film lies without --out
    double idle = 60;              // s without a new frame, after which the film ends
};

class Followed {
  public:
    virtual ~Followed() = default;

    // The folder of the run that is made, and its scene. They are known after wait_for_first(); those of a
    // job are known before.
    virtual const std::filesystem::path& folder() const = 0;
    virtual const FilmedScene& scene() const = 0;
    // The plan that says of which moments there will be pictures; null: of each frame that comes.
    virtual const Plan* plan() const { return nullptr; }
    // What the user should know before the first picture.
    virtual std::vector<std::string> news() const { return {}; }

    // Waits for the first frame, as long as the request allows. Throws UserError where none comes.
    virtual void wait_for_first() = 0;
    // Tells what is followed, and until when.
    virtual void tell_begin() const = 0;
    // Files the next whole frame. False where there is none so far. What is wrong with it is told by
    // finish().
    virtual bool take_next() = 0;
    virtual std::int64_t frames() const = 0;  // that are filed
    // Whether no more frames come if take_next() now finds none. idle: nothing has come for as long as the
    // user wants to wait.
    virtual bool is_over(bool idle) = 0;
    // To be called at the end, when the folder is not read any more. Warns of frames that did not come, and
    // throws RunError if that is a failure.
    virtual void finish() = 0;
};

// version: that of our program. The listener must outlive the result. Both throw UserError where the options
// or the film's scene do not fit.
std::unique_ptr<Followed> follow_files(const FollowRequest& what, const std::string& version,
                                       Listener& listener);
std::unique_ptr<Followed> follow_job(const FollowRequest& what, const std::string& version,
                                     Listener& listener);

}  // namespace grainreel
