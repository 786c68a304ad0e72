// The pictures of a film that were taken before its run was broken off, from their kept moments.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "engine/files/frames/frame_archive.hpp"
#include "engine/files/wear_file.hpp"
#include "engine/measure/measures.hpp"
#include "engine/run/driver/run_files.hpp"
#include "render/film/sampling/sampler.hpp"
#include "render/film/sources/frame_source.hpp"
#include "render/film/sources/picture_parts.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

class EarlierPictures final : private PartSupply {
  public:
    // run: folder; shots: of the film; count: how many of its kept moments are pictures of it. measures: rows
    // of the run, those of `shown` too; null without a film that shows any. files: know what has flowed out.
    // wear: of a film whose walls have its colours, else null.
    EarlierPictures(const FilmedScene& scene, const Clock& clock, const std::filesystem::path& run,
                    const std::vector<Shot>& shots, std::size_t count,
                    std::shared_ptr<const MeasureTable> measures, const RunFiles& files,
                    std::shared_ptr<const WearReader> wear);

    // Empty after the last.
    std::optional<Taken> next();

  private:
    FramePtr at(std::int64_t) const override { return nullptr; }
    std::vector<Touch> touches(const Frame&) const override { return {}; }
    Measured measured(const Frame& frame) const override;
    std::optional<FlowedOut> flowed_out(const Frame& frame) const override {
        return files_.flowed_out(frame.time);
    }
    std::shared_ptr<const std::vector<MeshWear>> worn(const Frame& frame) const override {
        return wear_ ? wear_->until(frame.time) : nullptr;
    }
    std::size_t rows_until(std::int64_t step) const;
    int periods_at(std::int64_t step) const;

    const FilmedScene& scene_;
    const RunFiles& files_;
    std::unique_ptr<FrameArchive> moments_;
    std::vector<Shot> shots_;
    std::size_t count_, next_ = 0;
    std::shared_ptr<const MeasureTable> measures_;
    std::shared_ptr<const WearReader> wear_;
    std::vector<double> steps_, periods_;  // of the rows
    PictureParts parts_;
};

}  // namespace grainreel
