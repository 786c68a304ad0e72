// The file of a checkpoint: name, version and checksum, the scene, the grains, and behind them the state of
// the step loop. That part is bytes here, so that grains can be read where there are no laws.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <ostream>
#include <string>
#include <string_view>

#include "engine/base/vector.hpp"
#include "engine/state/grains.hpp"

namespace grainreel {

struct CheckpointHeader {
    std::int64_t step = 0;
    double start_energy = 0;  // J, of the balance
    Vec3 wall_offset{0, 0, 0}, wall_velocity{0, 0, 0};
};

// Whether a file is a checkpoint, of this version or another; and whether a file that begins with these bytes
// is one.
bool is_checkpoint(const std::filesystem::path& path);
bool begins_checkpoint(std::string_view bytes);

// What a checkpoint says of itself, without looking at the rest: its step, and the scene as it was used.
// None where there is no such file, or it is of another version or cut off.
struct CheckpointLabel {
    std::int64_t step = 0;
    std::string scene;
    Vec3 wall_offset{0, 0, 0};  // m, of the container
};
std::optional<CheckpointLabel> label_of_checkpoint(const std::filesystem::path& path);

// Whether it has the bytes that were written, by its checksum.
bool is_whole_checkpoint(const std::filesystem::path& path);

// A checkpoint that was read whole. Its grains are not checked here; the code that uses them does that.
class CheckpointFile {
  public:
    enum class Fault { none, unreadable, other_version, damaged };

    // Never throws: what is wrong is in fault(), and there is nothing else then.
    explicit CheckpointFile(const std::filesystem::path& path);
    CheckpointFile(CheckpointFile&&) = default;
    CheckpointFile& operator=(CheckpointFile&&) = delete;

    Fault fault() const { return fault_; }

    std::string scene;  // as text
    CheckpointHeader header;
    bool fresh = false;
    std::string gathered;  // by observers
    Grains grains;
    // What the step loop keeps.
    std::string_view rest() const { return rest_; }

  private:
    Fault read();

    std::string bytes_;
    std::string_view rest_;
    Fault fault_ = Fault::none;
};

// The grains as the file has them.
void write_grains(std::ostream& out, const Grains& grains);

// body: all that follows the checksum. To a temporary name, then renamed. Throws RunError.
void write_checkpoint_file(const std::filesystem::path& path, const std::string& body);

}  // namespace grainreel
