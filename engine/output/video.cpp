#include "engine/output/video.h"

#include <array>
#include <cerrno>
#include <cstring>
#include <string>
#include <vector>

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fmt/format.h>

#include "engine/base/atomic_file.h"
#include "engine/base/check.h"
#include "engine/base/ignored_pipe_signal.h"

namespace scree::output {

namespace {

constexpr int not_installed = 127;

using Words = std::vector<std::string>;

// One thread and no random numbers in the file: the same images give the same bytes. Of a disk that is full only the end of the
// file tells at times, which is an error for ffmpeg if it is asked to end on errors.
Words command(const std::filesystem::path& target, const std::string& container, const VideoFormat& format) {
  Words words{"ffmpeg", "-loglevel", "error", "-xerror", "-y", "-f", "rawvideo", "-pixel_format", "rgb24"};
  const auto add = [&](const Words& more) { words.insert(words.end(), more.begin(), more.end()); };
  add({"-video_size", fmt::format("{}x{}", format.width, format.height), "-framerate", fmt::format("{:g}", format.rate)});
  add({"-i", "-", "-vf", "vflip", "-pix_fmt", "yuv420p"});
  if (container == "webm") add({"-c:v", "libvpx-vp9", "-crf", "32", "-b:v", "0", "-row-mt", "0", "-cpu-used", "4"});
  if (container == "mp4") add({"-c:v", "libx264", "-crf", "21", "-movflags", "+faststart"});
  add({"-threads", "1", "-fflags", "+bitexact", "-flags:v", "+bitexact", "-f", container, "file:" + target.string()});
  return words;
}

class Encoder {
 public:
  explicit Encoder(const Words& words) {
    std::array<int, 2> pipe{};
    if (::pipe2(pipe.data(), O_CLOEXEC) != 0) throw RunError(fmt::format("no pipe to ffmpeg ({})", std::strerror(errno)));
    std::vector<char*> arguments;
    for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    process_ = ::fork();
    if (process_ == 0) {
      // Where the program itself has no standard input the pipe may be it, and would be closed with the program's own files.
      if (pipe[0] == STDIN_FILENO) ::fcntl(STDIN_FILENO, F_SETFD, 0);
      ::dup2(pipe[0], STDIN_FILENO);
      ::execvp(arguments[0], arguments.data());
      ::_exit(errno == ENOENT ? not_installed : 1);
    }
    ::close(pipe[0]);
    input_ = pipe[1];
    if (process_ >= 0) return;
    ::close(input_);
    throw RunError("ffmpeg could not be started");
  }
  Encoder(const Encoder&) = delete;
  Encoder& operator=(const Encoder&) = delete;
  ~Encoder() {
    if (process_ > 0) finish();
  }

  // False if ffmpeg has ended: `finish` says why.
  bool take(const unsigned char* pixels, std::size_t size) {
    while (size > 0) {
      const ssize_t count = ::write(input_, pixels, size);
      if (count < 0 && errno == EINTR) continue;
      if (count <= 0) return false;
      pixels += count;
      size -= static_cast<std::size_t>(count);
    }
    return true;
  }

  // Ends the video and returns ffmpeg's exit status.
  int finish() {
    ::close(input_);
    int status = 0;
    TEMP_FAILURE_RETRY(::waitpid(process_, &status, 0));
    process_ = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 1;
  }

 private:
  pid_t process_ = -1;
  int input_ = -1;
};

struct Ended {};

void encode(const std::filesystem::path& target, const std::string& container, const VideoFormat& format,
            const std::function<void(const TakeImage&)>& draw) {
  const IgnoredPipeSignal ignored;
  Encoder encoder(command(target, container, format));
  const std::size_t size = 3 * static_cast<std::size_t>(format.width) * static_cast<std::size_t>(format.height);
  bool ended_early = false;
  try {
    draw([&](const unsigned char* pixels) {
      if (!encoder.take(pixels, size)) throw Ended{};
    });
  } catch (const Ended&) {
    ended_early = true;  // why is said below
  }
  const int status = encoder.finish();
  if (status == not_installed) {
    throw RunError("animations need ffmpeg, which is not installed. Run tools/setup, or apt-get install ffmpeg");
  }
  if (status != 0 || ended_early)
    throw RunError(fmt::format("{}: ffmpeg failed with status {}; its words stand above", target.string(), status));
}

}  // namespace

void write_video(const std::filesystem::path& file, const VideoFormat& format,
                 const std::function<void(const TakeImage&)>& draw) {
  const std::string end = file.extension().string();
  if (end != ".webm" && end != ".mp4") {
    Problem problem;
    problem.key = "--animation";
    problem.value = file.string();
    problem.rule = "a file whose name ends in .webm or .mp4";
    throw InputError(problem);
  }
  write_atomically(file, [&](const std::filesystem::path& temporary) { encode(temporary, end.substr(1), format, draw); });
}

}  // namespace scree::output
