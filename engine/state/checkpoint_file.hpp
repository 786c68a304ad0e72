// The file of a checkpoint: name, version and checksum, the scene, the grains, and after them the state of
// the step loop. Here that state is only bytes, so that grains can be read without any contact laws.
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

// The header is written as it lies in memory, so its members are a part of the file's format.
struct CheckpointHeader {
    std::int64_t step = 0;
    double start_energy = 0;  // J, energy at the start of the energy balance
    Vec3 wall_offset{0, 0, 0}, wall_velocity{0, 0, 0};
};

// is_checkpoint() says whether a file is a checkpoint, of this version or another. begins_checkpoint() says
// so for a file that begins with these bytes.
bool is_checkpoint(const std::filesystem::path& path);
bool begins_checkpoint(std::string_view bytes);

// The step of a checkpoint and the scene as it was used, read without the rest of the file. There is no label
// if the file does not exist, is cut off or has another version.
struct CheckpointLabel {
    std::int64_t step = 0;
    std::string scene;
    Vec3 wall_offset{0, 0, 0};  // m, of the container
};
std::optional<CheckpointLabel> label_of_checkpoint(const std::filesystem::path& path);

// Whether the file has the bytes that were written, by its checksum.
bool is_whole_checkpoint(const std::filesystem::path& path);

// A checkpoint that was read whole. Its grains are not checked here; the code that uses them does that.
class CheckpointFile {
  public:
    enum class Fault { none, unreadable, other_version, damaged };

    // Never throws. If something is wrong, fault() says what, and nothing else is set.
    explicit CheckpointFile(const std::filesystem::path& path);
    CheckpointFile(CheckpointFile&&) = default;
    CheckpointFile& operator=(CheckpointFile&&) = delete;

    Fault fault() const { return fault_; }

    std::string scene;  // as text
    CheckpointHeader header;
    bool fresh = false;
    std::string gathered;  // data that observers have gathered
    Grains grains;
    // The bytes of the step loop's state.
    std::string_view rest() const { return rest_; }

  private:
    Fault read();

    std::string bytes_;
    std::string_view rest_;
    Fault fault_ = Fault::none;
};

// Writes the grains in the format of the file.
void write_grains(std::ostream& out, const Grains& grains);

// Writes a checkpoint under a temporary name and then renames it. `body` is everything that follows the
// checksum. Throws RunError.
void write_checkpoint_file(const std::filesystem::path& path, const std::string& body);

}  // namespace grainreel
