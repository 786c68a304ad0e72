// Reads back what the program writes, with code of its own: colours come from formulas and not from swscale.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "render/picture/base/picture.hpp"

namespace grainreel::test {

// One decoded frame, planes without padding.
struct YuvFrame {
    int width = 0, height = 0;
    std::vector<std::uint8_t> y, u, v;  // u, v: half as wide and half as high
    double time = 0;                    // s
};

struct FilmFile {
    std::vector<YuvFrame> frames;   // in order of display, for films in Y'CbCr
    std::vector<Picture> pictures;  // in order of display, for films in RGB
    std::vector<double> times;      // s, of the frames or the pictures
    double duration = 0;            // s, as the file says; 0 if it does not
    std::string codec;              // FFmpeg's name
    int primaries = 0, transfer = 0, matrix = 0, range = 0, pixel_format = 0;  // FFmpeg's enums
    double rate = 0;
    std::map<std::string, std::string> metadata;
    int key_frames = 0;
};

// Reads everything that decodes. The film is empty when the file cannot be opened.
FilmFile read_film(const std::filesystem::path& path);

// Names of the top-level boxes of an MP4 file, in order.
std::vector<std::string> mp4_boxes(const std::filesystem::path& path);

using Code = std::array<double, 3>;  // Y, Cb, Cr in limited range, not rounded

// BT.709: Y' = 0.2126 R' + 0.7152 G' + 0.0722 B'; Cb = (B' - Y')/1.8556; Cr = (R' - Y')/1.5748 (ITU-R
// BT.709-6).
Code bt709_code(double red, double green, double blue);  // 0 to 255

// Turns a frame back into 8-bit RGB, with chroma from the nearest sample.
Picture to_rgb(const YuvFrame& frame);

// PSNR in dB over the common area of both pictures, without alpha.
double psnr(const Picture& a, const Picture& b);

struct PngFile {
    Picture picture;
    std::map<std::string, std::string> texts;
    std::map<std::string, int> text_kinds;  // libpng's compression codes: 1 is iTXt, not compressed
    bool srgb = false;
    int channels = 0;
};
PngFile read_png(const std::filesystem::path& path);

}  // namespace grainreel::test
