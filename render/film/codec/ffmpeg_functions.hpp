// The functions of FFmpeg that we call. Each library of FFmpeg is opened when one of its functions is called
// for the first time. These libraries load some seventy others. If every command opened them, its start would
// take twice as long. A function that is new to us gets a line here.
#pragma once

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavfilter/avfilter.h>
#include <libavfilter/buffersink.h>
#include <libavfilter/buffersrc.h>
#include <libavformat/avformat.h>
#include <libswscale/swscale.h>
}

#include <atomic>

namespace grainreel {

enum class FfmpegLibrary { avutil, avcodec, avformat, swscale, avfilter };

// A function's address. Opens its library where that has not happened yet. Throws RunError where the library
// is missing or lacks the function.
void* ffmpeg_function(FfmpegLibrary library, const char* name);

template <class Function>
class Late;

// Stands for the function of FFmpeg with its name, and is called like it. The first call looks the function
// up.
template <class Result, class... Arguments>
class Late<Result(Arguments...)> {
  public:
    constexpr Late(FfmpegLibrary library, const char* name) : library_(library), name_(name) {}

    Result operator()(Arguments... arguments) const {
        return reinterpret_cast<Result (*)(Arguments...)>(address())(arguments...);
    }

  private:
    void* address() const {
        void* known = address_.load(std::memory_order_acquire);
        if (!known) address_.store(known = ffmpeg_function(library_, name_), std::memory_order_release);
        return known;
    }

    mutable std::atomic<void*> address_ = nullptr;
    const FfmpegLibrary library_;
    const char* const name_;
};

// Inside this namespace a call by the plain name finds the object, because it hides the function. Each object
// is ready before any code runs.
#define GRAINREEL_LATE(library, function)                        \
    inline constinit const Late<decltype(::function)> function { \
        FfmpegLibrary::library, #function                        \
    }

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wignored-attributes"  // decltype drops attributes such as [[nodiscard]]

GRAINREEL_LATE(avutil, av_d2q);
GRAINREEL_LATE(avutil, av_dict_copy);
GRAINREEL_LATE(avutil, av_dict_free);
GRAINREEL_LATE(avutil, av_dict_set);
GRAINREEL_LATE(avutil, av_frame_alloc);
GRAINREEL_LATE(avutil, av_frame_clone);
GRAINREEL_LATE(avutil, av_frame_free);
GRAINREEL_LATE(avutil, av_frame_get_buffer);
GRAINREEL_LATE(avutil, av_frame_make_writable);
GRAINREEL_LATE(avutil, av_freep);
GRAINREEL_LATE(avutil, av_log_set_callback);
GRAINREEL_LATE(avutil, av_rescale);
GRAINREEL_LATE(avutil, av_rescale_q);
GRAINREEL_LATE(avutil, av_strdup);
GRAINREEL_LATE(avutil, av_strerror);
GRAINREEL_LATE(avutil, av_version_info);

GRAINREEL_LATE(avcodec, av_codec_is_encoder);
GRAINREEL_LATE(avcodec, av_packet_alloc);
GRAINREEL_LATE(avcodec, av_packet_free);
GRAINREEL_LATE(avcodec, av_packet_rescale_ts);
GRAINREEL_LATE(avcodec, av_packet_unref);
GRAINREEL_LATE(avcodec, avcodec_alloc_context3);
GRAINREEL_LATE(avcodec, avcodec_find_decoder);
GRAINREEL_LATE(avcodec, avcodec_find_encoder);
GRAINREEL_LATE(avcodec, avcodec_find_encoder_by_name);
GRAINREEL_LATE(avcodec, avcodec_free_context);
GRAINREEL_LATE(avcodec, avcodec_is_open);
GRAINREEL_LATE(avcodec, avcodec_open2);
GRAINREEL_LATE(avcodec, avcodec_parameters_copy);
GRAINREEL_LATE(avcodec, avcodec_parameters_from_context);
GRAINREEL_LATE(avcodec, avcodec_parameters_to_context);
GRAINREEL_LATE(avcodec, avcodec_receive_frame);
GRAINREEL_LATE(avcodec, avcodec_receive_packet);
GRAINREEL_LATE(avcodec, avcodec_send_frame);
GRAINREEL_LATE(avcodec, avcodec_send_packet);
GRAINREEL_LATE(avcodec, avcodec_version);

GRAINREEL_LATE(avformat, av_find_best_stream);
GRAINREEL_LATE(avformat, av_read_frame);
GRAINREEL_LATE(avformat, av_write_frame);
GRAINREEL_LATE(avformat, av_write_trailer);
GRAINREEL_LATE(avformat, avformat_alloc_output_context2);
GRAINREEL_LATE(avformat, avformat_close_input);
GRAINREEL_LATE(avformat, avformat_find_stream_info);
GRAINREEL_LATE(avformat, avformat_free_context);
GRAINREEL_LATE(avformat, avformat_new_stream);
GRAINREEL_LATE(avformat, avformat_open_input);
GRAINREEL_LATE(avformat, avformat_version);
GRAINREEL_LATE(avformat, avformat_write_header);
GRAINREEL_LATE(avformat, avio_closep);
GRAINREEL_LATE(avformat, avio_open);

GRAINREEL_LATE(swscale, sws_freeContext);
GRAINREEL_LATE(swscale, sws_getContext);
GRAINREEL_LATE(swscale, sws_scale);
GRAINREEL_LATE(swscale, swscale_version);

GRAINREEL_LATE(avfilter, av_buffersink_get_frame);
GRAINREEL_LATE(avfilter, av_buffersrc_add_frame_flags);
GRAINREEL_LATE(avfilter, avfilter_graph_alloc);
GRAINREEL_LATE(avfilter, avfilter_graph_config);
GRAINREEL_LATE(avfilter, avfilter_graph_free);
GRAINREEL_LATE(avfilter, avfilter_graph_get_filter);
GRAINREEL_LATE(avfilter, avfilter_graph_parse2);
GRAINREEL_LATE(avfilter, avfilter_inout_free);

#pragma GCC diagnostic pop
#undef GRAINREEL_LATE

}  // namespace grainreel
