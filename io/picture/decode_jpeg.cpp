#include "io/picture/decode_jpeg.h"

#include "radiosity/base/error.h"

#ifdef RADIOSITY_HAS_JPEG

#include <fmt/format.h>

#include <array>
#include <csetjmp>
#include <cstdint>
#include <cstdio>
// libjpeg wants to know FILE.
#include <jpeglib.h>

#include <string>
#include <vector>

namespace io {
namespace {

/// How libjpeg tells of faults: it must not return, and must not meet destructors on its way.
struct JpegFault {
  jpeg_error_mgr manager;
  std::jmp_buf back;
  std::array<char, JMSG_LENGTH_MAX> message;
};

void leave(j_common_ptr info) {
  auto* fault = reinterpret_cast<JpegFault*>(info->err);  // its first member
  info->err->format_message(info, fault->message.data());
  std::longjmp(fault->back, 1);
}

/// A fault that libjpeg would make up for, as a file that is cut off: the picture is another one.
void refuse_fault(j_common_ptr info, int level) {
  if (level < 0) leave(info);
}

/// A picture on its way out of a file. What jumps are over holds no object with a destructor.
class JpegInput {
 public:
  explicit JpegInput(std::string_view file) : file_(file) {
    info_.err = jpeg_std_error(&fault_.manager);
    fault_.manager.error_exit = leave;
    fault_.manager.emit_message = refuse_fault;
  }
  JpegInput(const JpegInput&) = delete;
  JpegInput& operator=(const JpegInput&) = delete;
  ~JpegInput() { jpeg_destroy_decompress(&info_); }

  bool read_header() {
    if (setjmp(fault_.back) != 0) return false;
    jpeg_create_decompress(&info_);
    jpeg_mem_src(&info_, reinterpret_cast<const unsigned char*>(file_.data()),
                 static_cast<unsigned long>(file_.size()));
    jpeg_read_header(&info_, TRUE);
    info_.out_color_space = JCS_RGB;
    jpeg_calc_output_dimensions(&info_);
    return true;
  }

  /// Into `bytes`, three for each pixel.
  bool read_pixels(std::uint8_t* bytes) {
    if (setjmp(fault_.back) != 0) return false;
    jpeg_start_decompress(&info_);
    while (info_.output_scanline < info_.output_height) {
      JSAMPROW row = bytes + std::size_t{3} * info_.output_width * info_.output_scanline;
      jpeg_read_scanlines(&info_, &row, 1);
    }
    jpeg_finish_decompress(&info_);
    return true;
  }

  [[nodiscard]] std::size_t width() const { return info_.output_width; }
  [[nodiscard]] std::size_t height() const { return info_.output_height; }
  [[noreturn]] void fail() const {
    throw radiosity::SceneError(
        fmt::format("is a damaged JPEG, or one of a kind that is not read: "
                    "{}",
                    fault_.message.data()));
  }

 private:
  std::string_view file_;
  jpeg_decompress_struct info_ = {};
  JpegFault fault_ = {};
};

}  // namespace

RgbPicture decode_jpeg(std::string_view file, std::size_t most_pixels) {
  JpegInput input(file);
  if (!input.read_header()) input.fail();
  check_picture_size(input.width(), input.height(), most_pixels);
  std::vector<std::uint8_t> bytes(3 * input.width() * input.height());
  if (!input.read_pixels(bytes.data())) input.fail();
  return {static_cast<int>(input.width()), static_cast<int>(input.height()), std::move(bytes)};
}

}  // namespace io

#else

namespace io {

RgbPicture decode_jpeg(std::string_view /*file*/, std::size_t /*most_pixels*/) {
  throw radiosity::SceneError("is a JPEG, for which this program was built without libjpeg");
}

}  // namespace io

#endif
