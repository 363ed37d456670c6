// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT

// Looks through a camera by OpenCV and shows what it sees:
//     07_camera MODEL.safetensors [SOURCE [OUT.avi]]
// MODEL is of `ism train` with its default features. SOURCE is the number of a camera (0), a video file, or
// numbered images such as "frame_%03d.png". With OUT pictures go to a video file instead of a window; ESC
// ends it.
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

#include <opencv2/highgui.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>

#include "ism/adapt/opencv.hpp"
#include "ism/core/stopwatch.hpp"
#include "ism/detect/detect.hpp"
#include "ism/detect/exemplar_segmenter.hpp"
#include "ism/detect/template_recognition.hpp"
#include "ism/feature/hessian_laplace.hpp"
#include "ism/feature/sift.hpp"
#include "ism/model_file/model_file.hpp"

namespace {

cv::VideoCapture open(const std::string& source) {
    const bool is_number = source.find_first_not_of("0123456789") == std::string::npos;
    cv::VideoCapture capture =
        is_number ? cv::VideoCapture(std::atoi(source.c_str())) : cv::VideoCapture(source);
    ism::expect(capture.isOpened(), source, is_number ? "a camera" : "a video or numbered images", "none");
    return capture;
}

void draw(cv::Mat& picture, const ism::Detection& object, const std::string& name) {
    const cv::Scalar color(80, 200, 60);
    std::vector<std::vector<cv::Point>> outline;
    cv::findContours(ism::to_mat(object.segmentation, picture.size()), outline, cv::RETR_EXTERNAL,
                     cv::CHAIN_APPROX_SIMPLE);
    cv::drawContours(picture, outline, -1, color, 2);
    const cv::Rect box = ism::to_rect(object.box, picture.size());
    cv::rectangle(picture, box, color);
    char text[100];
    std::snprintf(text, sizeof text, "%s %.2f", name.c_str(), object.probability);
    cv::putText(picture, text, box.tl() + cv::Point(4, 16), cv::FONT_HERSHEY_SIMPLEX, 0.5, color);
}

}  // namespace

int main(int argc, char** argv) try {
    if (argc < 2 || argc > 4) {
        std::fprintf(stderr, "usage: %s MODEL.safetensors [CAMERA|VIDEO [OUT.avi]]\n", argv[0]);
        return 2;
    }
    const auto model = ism::load_model<ism::HessianLaplace, ism::RootSift>(argv[1]);
    std::error_code none;  // of files that are not there
    if (argc > 3 && std::filesystem::equivalent(argv[2], argv[3], none))
        throw ism::Error("OUT.avi: expected another file than the video that is read");
    cv::VideoCapture capture = open(argc > 2 ? argv[2] : "0");
    cv::VideoWriter writer;

    ism::FrameDetector detector(model);
    const ism::Recognition<ism::Jism> by_votes;
    auto by_templates = ism::template_recognition(ism::ExemplarSegmenter{});
    by_templates.options.min_probability = 0.2;
    cv::Mat picture;  // b, g, r
    for (int i = 1; capture.read(picture); ++i) {
        ism::Stopwatch watch;
        const ism::Frame frame = ism::to_frame(picture);
        const ism::Detections found =
            model.templates.empty() ? detector.detect(frame, by_votes) : detector.detect(frame, by_templates);
        std::printf("%d: %.0f ms", i, watch.lap_ms());
        for (const ism::Detection& object : found.objects) {
            const std::string& name = model.shapes.class_names[object.class_index];
            std::printf(" %s %.2f;", name.c_str(), object.probability);
            draw(picture, object, name);
        }
        std::printf("\n");
        if (argc == 4) {
            if (!writer.isOpened())
                writer.open(argv[3], cv::VideoWriter::fourcc('M', 'J', 'P', 'G'), 10, picture.size());
            ism::expect(writer.isOpened(), argv[3], "a video file that can be written (.avi)", "none");
            writer.write(picture);
        } else {
            cv::imshow("ism", picture);
            if (cv::waitKey(1) == 27) break;
        }
    }
} catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
}
