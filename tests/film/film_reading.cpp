// Reads films and PNG files back for tests, through the libraries' decoders.
#include "tests/film/film_reading.hpp"

#include <png.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <stdexcept>

#include "render/film/codec/ffmpeg.hpp"

namespace grainreel::test {
namespace {

std::vector<std::uint8_t> plane(const AVFrame& frame, int index, int width, int height) {
    std::vector<std::uint8_t> out;
    for (int y = 0; y < height; ++y) {
        const std::uint8_t* row = frame.data[index] + static_cast<std::ptrdiff_t>(y) * frame.linesize[index];
        out.insert(out.end(), row, row + width);
    }
    return out;
}

YuvFrame copy_of(const AVFrame& frame, AVRational time_base) {
    YuvFrame out;
    out.width = frame.width;
    out.height = frame.height;
    out.y = plane(frame, 0, frame.width, frame.height);
    out.u = plane(frame, 1, frame.width / 2, frame.height / 2);
    out.v = plane(frame, 2, frame.width / 2, frame.height / 2);
    out.time = static_cast<double>(frame.best_effort_timestamp) * av_q2d(time_base);
    return out;
}

// These films have two orders of bytes: B, G, R and alpha, or B, G, R and an unused byte.
Picture rgb_copy_of(const AVFrame& frame) {
    if (frame.format != AV_PIX_FMT_BGR0 && frame.format != AV_PIX_FMT_BGRA)
        throw std::runtime_error("neither yuv420p nor bgr0 nor bgra");
    Picture out(frame.width, frame.height);
    for (int y = 0; y < frame.height; ++y) {
        const std::uint8_t* row = frame.data[0] + static_cast<std::ptrdiff_t>(y) * frame.linesize[0];
        for (int x = 0; x < frame.width; ++x, row += 4) {
            std::uint8_t* to = out.pixel(x, y);
            to[0] = row[2], to[1] = row[1], to[2] = row[0];
            to[3] = frame.format == AV_PIX_FMT_BGRA ? row[3] : 255;
        }
    }
    return out;
}

// Takes the frames that the decoder gives for one packet. The packet is null at the end.
void decode(AVCodecContext& codec, const AVPacket* packet, AVRational time_base, FilmFile& film) {
    if (avcodec_send_packet(&codec, packet) < 0) return;
    const AvFramePtr frame(av_frame_alloc());
    while (avcodec_receive_frame(&codec, frame.get()) >= 0) {
        film.times.push_back(static_cast<double>(frame->best_effort_timestamp) * av_q2d(time_base));
        if (frame->format == AV_PIX_FMT_YUV420P)
            film.frames.push_back(copy_of(*frame, time_base));
        else
            film.pictures.push_back(rgb_copy_of(*frame));
    }
}

void read_tags(const AVFormatContext& file, FilmFile& film) {
    const AVCodecParameters& codec = *file.streams[0]->codecpar;
    film.primaries = codec.color_primaries;
    film.transfer = codec.color_trc;
    film.matrix = codec.color_space;
    film.range = codec.color_range;
    film.pixel_format = codec.format;
    film.rate = av_q2d(file.streams[0]->avg_frame_rate);
    film.duration = file.duration == AV_NOPTS_VALUE ? 0 : static_cast<double>(file.duration) / AV_TIME_BASE;
    film.codec = avcodec_get_name(codec.codec_id);
    const AVDictionaryEntry* entry = nullptr;
    while ((entry = av_dict_get(file.metadata, "", entry, AV_DICT_IGNORE_SUFFIX)))
        film.metadata[entry->key] = entry->value;
}

}  // namespace

FilmFile read_film(const std::filesystem::path& path) {
    quiet_ffmpeg();
    FilmFile film;
    AVFormatContext* context = nullptr;
    if (avformat_open_input(&context, ("file:" + path.string()).c_str(), nullptr, nullptr) < 0) return film;
    const InputPtr file(context);
    if (avformat_find_stream_info(context, nullptr) < 0 || file->nb_streams != 1) return film;
    read_tags(*file, film);
    const AVStream& stream = *file->streams[0];
    const CodecPtr codec(avcodec_alloc_context3(avcodec_find_decoder(stream.codecpar->codec_id)));
    avcodec_parameters_to_context(codec.get(), stream.codecpar);
    if (avcodec_open2(codec.get(), nullptr, nullptr) < 0) return film;
    const PacketPtr packet(av_packet_alloc());
    while (av_read_frame(context, packet.get()) >= 0) {
        if (packet->flags & AV_PKT_FLAG_KEY) ++film.key_frames;
        decode(*codec, packet.get(), stream.time_base, film);
        av_packet_unref(packet.get());
    }
    decode(*codec, nullptr, stream.time_base, film);
    return film;
}

std::vector<std::string> mp4_boxes(const std::filesystem::path& path) {
    std::vector<std::string> names;
    std::ifstream in(path, std::ios::binary);
    std::array<unsigned char, 8> head{};
    std::streamoff at = 0;
    while (in.seekg(at) && in.read(reinterpret_cast<char*>(head.data()), 8)) {
        const std::uint32_t size = std::uint32_t{head[0]} << 24 | std::uint32_t{head[1]} << 16 |
                                   std::uint32_t{head[2]} << 8 | std::uint32_t{head[3]};
        names.emplace_back(reinterpret_cast<const char*>(head.data()) + 4, 4);
        if (size < 8) break;  // a 64-bit size, which no film of these tests needs
        at += size;
    }
    return names;
}

Code bt709_code(double red, double green, double blue) {
    const double luma = 0.2126 * red + 0.7152 * green + 0.0722 * blue;
    return {16 + 219 * luma / 255, 128 + 224 * (blue - luma) / 1.8556 / 255,
            128 + 224 * (red - luma) / 1.5748 / 255};
}

Picture to_rgb(const YuvFrame& frame) {
    Picture picture(frame.width, frame.height);
    const auto byte = [](double value) {
        return static_cast<std::uint8_t>(std::clamp(value + 0.5, 0.0, 255.0));
    };
    for (int y = 0; y < frame.height; ++y) {
        for (int x = 0; x < frame.width; ++x) {
            const std::size_t half = static_cast<std::size_t>(y / 2) * (frame.width / 2) + x / 2;
            const double luma = (frame.y[static_cast<std::size_t>(y) * frame.width + x] - 16) * 255.0 / 219;
            const double blue = luma + 1.8556 * (frame.u[half] - 128) * 255.0 / 224;
            const double red = luma + 1.5748 * (frame.v[half] - 128) * 255.0 / 224;
            std::uint8_t* pixel = picture.pixel(x, y);
            pixel[0] = byte(red);
            pixel[1] = byte((luma - 0.2126 * red - 0.0722 * blue) / 0.7152);
            pixel[2] = byte(blue);
            pixel[3] = 255;
        }
    }
    return picture;
}

double psnr(const Picture& a, const Picture& b) {
    const int width = std::min(a.width, b.width), height = std::min(a.height, b.height);
    double sum = 0;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < 3; ++c) {
                const double difference = a.pixel(x, y)[c] - b.pixel(x, y)[c];
                sum += difference * difference;
            }
    return 10 * std::log10(255.0 * 255.0 * 3 * width * height / std::max(sum, 1e-9));
}

PngFile read_png(const std::filesystem::path& path) {
    std::FILE* file = std::fopen(path.c_str(), "rb");
    if (!file) throw std::runtime_error("no file " + path.string());
    png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(png);
    if (setjmp(png_jmpbuf(png))) throw std::runtime_error("not a whole PNG: " + path.string());
    png_init_io(png, file);
    png_read_info(png, info);
    PngFile out;
    out.channels = png_get_channels(png, info);
    out.picture = Picture(static_cast<int>(png_get_image_width(png, info)),
                          static_cast<int>(png_get_image_height(png, info)));
    if (out.channels == 3) png_set_filler(png, 255, PNG_FILLER_AFTER);
    for (int y = 0; y < out.picture.height; ++y) png_read_row(png, out.picture.pixel(0, y), nullptr);
    png_read_end(png, info);
    int intent = -1;
    out.srgb = png_get_sRGB(png, info, &intent) != 0;
    png_textp texts = nullptr;
    const int count = png_get_text(png, info, &texts, nullptr);
    for (int i = 0; i < count; ++i) {
        out.texts[texts[i].key] = texts[i].text;
        out.text_kinds[texts[i].key] = texts[i].compression;
    }
    png_destroy_read_struct(&png, &info, nullptr);
    std::fclose(file);
    return out;
}

}  // namespace grainreel::test
