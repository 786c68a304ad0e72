// The table of grains of a final.csv: the last of the frames.
#include <optional>

#include "engine/base/error.hpp"
#include "engine/files/frames/frame_writer.hpp"
#include "engine/grain_table.hpp"

namespace grainreel {

namespace {

class GrainTable final : public FrameWriter {
  public:
    explicit GrainTable(std::filesystem::path path) : path_(std::move(path)) {}

    void begin(const World&, const FrameSupply&) override {}
    void frame(const Frame& frame) override { last_ = frame; }
    void end() override {
        if (!last_) throw RunError(path_.string() + ": there is no frame to make a table of");
        write_grain_table(path_, *last_);
    }

  private:
    std::filesystem::path path_;
    std::optional<Frame> last_;
};

std::unique_ptr<FrameWriter> make(const std::filesystem::path& path) {
    return std::make_unique<GrainTable>(path);
}

}  // namespace

FrameFormat grain_table_format() {
    return {"grain-table", "a table of grains (final.csv), of the last frame", ".csv", make};
}

}  // namespace grainreel
