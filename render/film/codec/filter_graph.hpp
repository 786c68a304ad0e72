// One filter of libavfilter between frames that go in and frames that come out.
#pragma once

#include <memory>
#include <string>

#include "render/film/codec/ffmpeg_handles.hpp"

struct AVFilterGraph;
struct AVFilterContext;

namespace grainreel {

class FilterGraph {
  public:
    // frames: of the size and pixels of `codec`. second: a still for the filter's second input, if it has
    // one. Throws RunError.
    FilterGraph(const AVCodecContext& codec, const std::string& filter, const AVFrame* second = nullptr);

    void push(AVFrame& frame);  // stays the caller's
    void end();                 // no more frames
    AvFramePtr pull();          // null when there is none yet

  private:
    struct Free {
        void operator()(AVFilterGraph* graph) const;
    };
    std::unique_ptr<AVFilterGraph, Free> graph_;
    AVFilterContext *source_ = nullptr, *sink_ = nullptr;
    std::int64_t pushed_ = 0;
};

}  // namespace grainreel
