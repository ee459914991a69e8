// Images into a video file, through ffmpeg.
#pragma once

#include <filesystem>
#include <functional>

namespace scree::output {

struct VideoFormat {
  int width = 0;    // [pixels], even
  int height = 0;   // even
  double rate = 0;  // frames per second
};

// Takes one image: rows of RGB, bottom row first.
using TakeImage = std::function<void(const unsigned char* pixels)>;

// Calls `draw`, which hands its images over one by one. The name's end says how: .webm is VP9, .mp4 is H.264. The same images
// give the same bytes. Throws InputError for another end, and RunError if ffmpeg is missing or fails; the file is whole or not
// there.
void write_video(const std::filesystem::path& file, const VideoFormat& format,
                 const std::function<void(const TakeImage&)>& draw);

}  // namespace scree::output
