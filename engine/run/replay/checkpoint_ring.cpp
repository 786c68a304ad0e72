#include "engine/run/replay/checkpoint_ring.hpp"

#include <algorithm>
#include <charconv>
#include <optional>
#include <system_error>

#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/start/restart.hpp"

namespace grainreel {

namespace fs = std::filesystem;

namespace {

// The name of a checkpoint in the ring: "000000012345.grs".
std::string file_name(std::int64_t step) {
    return fmt::format("{:012}.grs", step);
}

std::optional<std::int64_t> step_in(const fs::path& file) {
    const std::string stem = file.stem().string();
    std::int64_t step = -1;
    const auto end = std::from_chars(stem.data(), stem.data() + stem.size(), step).ptr;
    const bool whole = end == stem.data() + stem.size() && file.extension() == ".grs" && step >= 0;
    return whole ? std::optional(step) : std::nullopt;
}

std::vector<KeptCheckpoint> those_in(const fs::path& folder) {
    std::vector<KeptCheckpoint> found;
    std::error_code error;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
        const std::optional<std::int64_t> step = step_in(entry.path());
        if (step) found.push_back({*step, entry.path(), entry.file_size(error)});
    }
    std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.step < b.step; });
    return found;
}

}  // namespace

std::vector<KeptCheckpoint> kept_checkpoints(const fs::path& run) {
    std::vector<KeptCheckpoint> found = those_in(run / CheckpointRing::kFolder);
    const fs::path last = run / "checkpoint.grs";
    if (const auto label = label_of_checkpoint(last)) {
        std::error_code error;
        const auto after =
            std::upper_bound(found.begin(), found.end(), label->step,
                             [](std::int64_t step, const auto& one) { return step < one.step; });
        found.insert(after, {label->step, last, fs::file_size(last, error)});
    }
    return found;
}

fs::path place_in_ring(const fs::path& run, std::int64_t step) {
    return run / CheckpointRing::kFolder / file_name(step);
}

CheckpointRing::CheckpointRing(const fs::path& run, std::int64_t most_bytes, std::int64_t first,
                               std::int64_t last)
    : folder_(run / kFolder), most_bytes_(static_cast<std::uintmax_t>(most_bytes)), last_(last) {
    const std::error_code error = make_plain_folder(folder_);
    if (error) throw RunError("{}: cannot be made: {}", folder_.string(), error.message());
    kept_ = those_in(folder_);
    while (!kept_.empty() && kept_.back().step > first) remove(kept_.size() - 1);
}

bool CheckpointRing::due(std::int64_t step) const {
    if (none_fits_) return false;
    if (kept_.empty()) return true;
    const std::uintmax_t fit = most_bytes_ / std::max<std::uintmax_t>(1, kept_.back().bytes);
    const auto parts = static_cast<std::int64_t>(std::clamp<std::uintmax_t>(fit, 1, kMost));
    const std::int64_t span = last_ - kept_.front().step;
    return step - kept_.back().step >= std::max<std::int64_t>(1, (span + parts - 1) / parts);
}

void CheckpointRing::add(std::int64_t step, const std::function<void(const fs::path&)>& save) {
    const fs::path file = folder_ / file_name(step);
    save(file);
    std::error_code error;
    kept_.push_back({step, file, fs::file_size(file, error)});
    while (too_many()) {
        if (kept_.size() <= 2) {
            none_fits_ = kept_.size() == 1;
            remove(kept_.size() - 1);
            continue;
        }
        std::size_t closest = 1;
        for (std::size_t i = 1; i + 1 < kept_.size(); ++i)
            if (kept_[i + 1].step - kept_[i - 1].step < kept_[closest + 1].step - kept_[closest - 1].step)
                closest = i;
        remove(closest);
    }
}

bool CheckpointRing::too_many() const {
    std::uintmax_t bytes = 0;
    for (const KeptCheckpoint& one : kept_) bytes += one.bytes;
    return kept_.size() > kMost || bytes > most_bytes_;
}

void CheckpointRing::remove(std::size_t index) {
    std::error_code ignored;
    fs::remove(kept_[index].file, ignored);
    kept_.erase(kept_.begin() + static_cast<std::ptrdiff_t>(index));
}

}  // namespace grainreel
