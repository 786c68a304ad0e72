// Our access to FFmpeg: owners of its objects, its errors in words, and its filters. The other files about
// films use these.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "render/film/codec/ffmpeg_functions.hpp"

namespace grainreel {

void free_codec(AVCodecContext* codec);

struct FfmpegDeleter {
    void operator()(AVCodecContext* p) const { free_codec(p); }
    void operator()(AVFrame* p) const { av_frame_free(&p); }
    void operator()(AVPacket* p) const { av_packet_free(&p); }
    void operator()(SwsContext* p) const { sws_freeContext(p); }
};
// A file being read.
struct InputDeleter {
    void operator()(AVFormatContext* p) const { avformat_close_input(&p); }
};
// A file being written. Deleting closes the file but does not write the trailer, FFmpeg's last part of a
// file. Whoever wants a complete file writes the trailer before.
struct OutputDeleter {
    void operator()(AVFormatContext* p) const {
        avio_closep(&p->pb);
        avformat_free_context(p);
    }
};

using CodecPtr = std::unique_ptr<AVCodecContext, FfmpegDeleter>;
using AvFramePtr = std::unique_ptr<AVFrame, FfmpegDeleter>;
using PacketPtr = std::unique_ptr<AVPacket, FfmpegDeleter>;
using ScalerPtr = std::unique_ptr<SwsContext, FfmpegDeleter>;
using InputPtr = std::unique_ptr<AVFormatContext, InputDeleter>;
using OutputPtr = std::unique_ptr<AVFormatContext, OutputDeleter>;

// Opens all libraries of FFmpeg except libavfilter. From then on they and their codecs print nothing, except
// that SVT-AV1 prints its errors. The errors that FFmpeg logs are kept for ffmpeg_error(). Throws RunError
// where a library is missing.
void quiet_ffmpeg();

// Names and versions of FFmpeg and its libraries, as loaded. Opens them, and throws RunError where one is
// missing.
std::vector<std::pair<std::string, std::string>> ffmpeg_versions();

// Says in words what a negative return code of FFmpeg means: "No space left on device". If FFmpeg has logged
// an error since the previous call, the last such line follows in brackets.
std::string ffmpeg_error(int code);

// A dictionary of options that is freed in any case.
class AvOptions {
  public:
    AvOptions() = default;
    AvOptions(const AvOptions&) = delete;
    AvOptions& operator=(const AvOptions&) = delete;
    ~AvOptions() {
        if (dictionary_) av_dict_free(&dictionary_);  // a call would open FFmpeg, which may be missing
    }
    void set(const std::string& key, const std::string& value) {
        av_dict_set(&dictionary_, key.c_str(), value.c_str(), 0);
    }
    AVDictionary** get() { return &dictionary_; }

  private:
    AVDictionary* dictionary_ = nullptr;
};

// One filter of libavfilter between frames that go in and frames that come out.
class FilterGraph {
  public:
    // The frames that go in have the size and the pixel format of `codec`. second: a still picture for the
    // filter's second input, if it has one. Throws RunError.
    FilterGraph(const AVCodecContext& codec, const std::string& filter, const AVFrame* second = nullptr);

    void push(AVFrame& frame);  // the frame stays the caller's
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
