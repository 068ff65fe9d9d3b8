// SPDX-License-Identifier: BSD-3-Clause
#include "curve_kinds/strips.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

#include "base/angles.h"
#include "base/median.h"
#include "geometry/lens.h"

namespace curvix {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// A strip reaches from 2.5 px, beyond the blur of the edge itself, to 12.5 px
// from the curve, and 4 px along it to either side.
constexpr int kNumAcross = 11;
constexpr int kNumAlong = 5;
constexpr double kFirstAcrossPx = 2.5;
constexpr double kAlongStepPx = 2;
constexpr double kLastAcrossPx = kFirstAcrossPx + kNumAcross - 1;
constexpr double kSidePx = kNumAlong / 2 * kAlongStepPx;
constexpr int kNumPixels = kNumAcross * kNumAlong;
constexpr double kReachPx = 15;
// With this probability a surface does not reach as far, but to 6.5 px from the
// curve.
constexpr double kNarrowProbability = 0.2;
constexpr int kNumNarrowRows = 5;
// With this probability a surface ends at the next curve in its direction. Its
// strip is read up to the blur of that curve, if three rows are left.
constexpr double kEndsAtCurveProbability = 0.5;
constexpr double kOtherBlurPx = 1.5;
constexpr int kMinRows = 3;

constexpr std::size_t kMaxViews = 10;
constexpr int kMinViews = 3;
// The share of the views that must agree; others may be hidden.
constexpr double kAgreeingShare = 0.7;
// Strips that a view sees under a smaller angle are not compared.
constexpr double kMinSine = 0.25;

// The variance, in squared grey levels, by which strips of one surface differ:
// noise of the images and what is added to it, at least so much; and a share of
// the variance of the strip for what resampling and reflections do to it. And
// the share of strips of different things.
constexpr double kLeastVariance = 2;
constexpr double kAddedVariance = 1.4;
constexpr double kSameShare = 0.04;
constexpr double kOtherShare = 0.4;
// Neighbouring pixels are correlated: a strip beyond the first counts as so
// many independent ones.
constexpr double kIndependentPixels = 2;
// No single place decides.
constexpr float kMinLogBayes = -12;

using Strip = Eigen::Matrix<float, kNumPixels, 1>;

// How one view sees the surroundings of a place: the pixel of the place and
// what a step of one pixel of the place in space does to it.
struct LocalView {
  int view = 0;
  const BlurredImage* image = nullptr;
  double azimuth = 0;  // of the camera about the tangent, radians
  double pixel_size = 0;
  Vector2d pixel;  // of the image, from its first pixel's centre
  Vector2d along, normal, binormal;
};

std::optional<LocalView> Locate(const StripPlace& place,
                                int view_idx,
                                const Scene& scene,
                                const std::vector<PosedView>& views,
                                const std::vector<BlurredImage>& images) {
  const auto v = static_cast<std::size_t>(view_idx);
  const PosedView& view = views[v];
  const Camera& camera = CameraOf(scene, scene.views[v]);
  const BlurredImage& image = images[v];
  const Vector3d x = view.InCamera(place.position);
  if (!(x.z() > 0)) return std::nullopt;
  const Vector2d pixel = ImageFromIdeal(camera, x.hnormalized());
  if (!pixel.allFinite() || !image.Covers(pixel, kReachPx)) return std::nullopt;
  const Eigen::Matrix<double, 2, 3> jacobian =
      image.scale() * PixelJacobian(camera, x) * view.rotation;
  if (!jacobian.allFinite()) return std::nullopt;
  const Vector3d binormal = place.tangent.cross(place.normal);
  return LocalView{view_idx,
                   &image,
                   place.AngleOf(view.center - place.position),
                   x.z() / view.calibration(0, 0),
                   pixel * image.scale() - Vector2d(0.5, 0.5),
                   jacobian * place.tangent,
                   jacobian * place.normal,
                   jacobian * binormal};
}

std::vector<LocalView> LocateAll(const StripPlace& place,
                                 const std::vector<int>& view_idxs,
                                 const Scene& scene,
                                 const std::vector<PosedView>& views,
                                 const std::vector<BlurredImage>& images) {
  std::vector<LocalView> located;
  for (const int view : view_idxs) {
    const auto local = Locate(place, view, scene, views, images);
    if (local) located.push_back(*local);
  }
  return located;
}

// At most kMaxViews of the views, spread over their azimuths, without those
// that see the place at half the resolution of most or less.
std::vector<LocalView> ChooseViews(std::vector<LocalView> seen) {
  std::vector<double> sizes;
  for (const LocalView& view : seen) sizes.push_back(view.pixel_size);
  const double usual = MedianOr(0, std::move(sizes));
  std::erase_if(
      seen, [&](const LocalView& view) { return view.pixel_size > 2 * usual; });
  std::ranges::stable_sort(seen, {}, &LocalView::azimuth);
  if (seen.size() <= kMaxViews) return seen;
  std::vector<LocalView> chosen;
  for (std::size_t i = 0; i < kMaxViews; ++i) {
    chosen.push_back(seen[i * (seen.size() - 1) / (kMaxViews - 1)]);
  }
  return chosen;
}

// The box of the pixels from which strips in any direction are interpolated,
// with a margin of one pixel for rounding. `step`: that of StripViews.
Eigen::AlignedBox2i PixelsOfStrips(const LocalView& view, double step) {
  const Eigen::Array2d across =
      (view.normal.cwiseAbs2() + view.binormal.cwiseAbs2()).cwiseSqrt();
  const Eigen::Array2d reach =
      step * (std::hypot(kLastAcrossPx, kDepthsPx.back()) * across +
              kSidePx * view.along.array().abs());
  const Eigen::Array2d size(view.image->width(), view.image->height());
  const Eigen::Array2d first = (view.pixel.array() - reach - 1).max(0);
  const Eigen::Array2d last = (view.pixel.array() + reach + 1).min(size - 1);
  return {first.cast<int>().matrix(), last.cast<int>().matrix()};
}

// The grey levels of a strip less their mean; false if the image does not hold
// all of it. `begin` is the pixel where the surface begins; `across` is the
// image of a step of one pixel away from there, `along` of one along the curve.
bool Sample(const LocalView& view,
            const Vector2d& begin,
            const Vector2d& across,
            const Vector2d& along,
            Strip* strip) {
  const Vector2d near = kFirstAcrossPx * across;
  const Vector2d far = kLastAcrossPx * across;
  const Vector2d side = kSidePx * along;
  for (const Vector2d& corner : {Vector2d(near - side),
                                 Vector2d(near + side),
                                 Vector2d(far - side),
                                 Vector2d(far + side)}) {
    const Vector2d at = begin + corner;
    if (!(at.x() >= 0 && at.y() >= 0 && at.x() < view.image->width() - 1 &&
          at.y() < view.image->height() - 1)) {
      return false;
    }
  }
  std::array<float, kNumPixels> x, y;
  std::size_t i = 0;
  for (int a = 0; a < kNumAcross; ++a) {
    Vector2d at = begin + (kFirstAcrossPx + a) * across - side;
    for (int b = 0; b < kNumAlong; ++b, ++i, at += kAlongStepPx * along) {
      x[i] = static_cast<float>(at.x());
      y[i] = static_cast<float>(at.y());
    }
  }
  view.image->LookUp(x, y, strip->data());
  strip->array() -= strip->mean();
  return true;
}

// The strips of some views.
class StripSet {
 public:
  void Clear() { num_ = 0; }
  Strip* Next() { return &strips_[static_cast<std::size_t>(num_)]; }
  void Keep() { ++num_; }

  // Minus infinity if there are fewer than kMinViews. `other_curve_px`: to the
  // nearest other curve in the direction.
  float LogBayes(double other_curve_px, double noise_variance) const;

 private:
  using Gram = Eigen::Matrix<float, kMaxViews, kMaxViews>;
  // Of the first pixels of each strip less their mean.
  Gram InnerProducts(int num_pixels) const;
  // That of the first rows of the strips that agree best.
  double LogBayesOfRows(int num_rows, double noise_variance) const;

  std::array<Strip, kMaxViews> strips_;
  int num_ = 0;
};

StripSet::Gram StripSet::InnerProducts(int num_pixels) const {
  Gram gram = Gram::Zero();  // DropWorst() reads whole columns
  std::array<float, kMaxViews> means;
  for (int i = 0; i < num_; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const auto first = strips_[k].head(num_pixels);
    const float sum = first.sum();
    means[k] = first.mean();
    for (std::size_t j = 0; j <= k; ++j) {
      const auto other = strips_[j].head(num_pixels);
      gram(i, static_cast<int>(j)) = gram(static_cast<int>(j), i) =
          first.dot(other) - sum * means[j];
    }
  }
  return gram;
}

// Drops the strip that is farthest from the others until kAgreeingShare of the
// first `num` are left, and gives the sum of the squared distances between
// those, in both orders.
template <typename Gram>
double DropWorst(const Gram& gram, int num, std::vector<int>* left) {
  left->resize(static_cast<std::size_t>(num));
  std::iota(left->begin(), left->end(), 0);
  const auto num_agreeing = static_cast<std::size_t>(
      std::max(kMinViews, static_cast<int>(std::ceil(kAgreeingShare * num))));
  Eigen::Array<double, kMaxViews, kMaxViews> squares;
  for (int j = 0; j < num; ++j) {
    squares.col(j) =
        (gram.diagonal().array() + gram(j, j) - 2 * gram.col(j).array())
            .template cast<double>();
  }
  while (true) {
    Eigen::Array<double, kMaxViews, 1> sums = squares.col(left->front());
    for (std::size_t k = 1; k < left->size(); ++k) {
      sums += squares.col((*left)[k]);
    }
    if (left->size() <= num_agreeing) {
      double sum = 0;
      for (const int i : *left) sum += sums[i];
      return sum;
    }
    left->erase(
        std::ranges::max_element(*left, {}, [&](int i) { return sums[i]; }));
  }
}

// The logarithm of the Bayes factor of one of two surfaces, the first with
// `probability`.
double Mixture(double probability, double log_bayes, double other_log_bayes) {
  return std::log(probability * std::exp(log_bayes) +
                  (1 - probability) * std::exp(other_log_bayes));
}

float StripSet::LogBayes(double other_curve_px, double noise_variance) const {
  if (num_ < kMinViews) return -std::numeric_limits<float>::infinity();
  double log_bayes = Mixture(kNarrowProbability,
                             LogBayesOfRows(kNumNarrowRows, noise_variance),
                             LogBayesOfRows(kNumAcross, noise_variance));
  const double readable_px = other_curve_px - kOtherBlurPx - kFirstAcrossPx;
  if (readable_px < kNumAcross - 1) {
    const int num_rows = static_cast<int>(std::floor(readable_px)) + 1;
    log_bayes = Mixture(
        kEndsAtCurveProbability,
        num_rows < kMinRows ? 0 : LogBayesOfRows(num_rows, noise_variance),
        log_bayes);
  }
  return std::max(static_cast<float>(log_bayes), kMinLogBayes);
}

double StripSet::LogBayesOfRows(int num_rows, double noise_variance) const {
  const int num_pixels = num_rows * kNumAlong;
  const Gram gram = InnerProducts(num_pixels);
  std::vector<int> left;
  const double total = DropWorst(gram, num_, &left);
  const auto num_left = static_cast<double>(left.size());
  double variance = 0;
  for (const int i : left) variance += static_cast<double>(gram(i, i));
  variance /= num_left * num_pixels;
  // `total` counts every pair twice.
  const double residual =
      total / (2.0 * num_left * (num_left - 1) * num_pixels);
  const double same = noise_variance + kSameShare * variance;
  const double other = noise_variance + kOtherShare * variance;
  const double num_independent =
      kIndependentPixels * num_pixels / kNumPixels * (num_left - 1);
  return -num_independent / 2 *
         (residual / same + std::log(same) - residual / other -
          std::log(other));
}

}  // namespace

StripViews ChooseStripViews(const StripPlace& place,
                            const Scene& scene,
                            const std::vector<PosedView>& views,
                            const std::vector<BlurredImage>& images) {
  const std::vector<LocalView> seen =
      ChooseViews(LocateAll(place, place.views, scene, views, images));
  StripViews chosen;
  if (seen.size() < kMinViews) return chosen;
  std::vector<double> sizes;
  for (const LocalView& view : seen) sizes.push_back(view.pixel_size);
  chosen.step = Median(std::move(sizes)) / seen.front().image->scale();
  for (const LocalView& view : seen) {
    chosen.views.push_back(view.view);
    chosen.boxes.push_back(PixelsOfStrips(view, chosen.step));
  }
  return chosen;
}

SurfaceEvidence CompareStrips(const StripPlace& place,
                              const StripViews& chosen,
                              const CurveDistances& other_curves,
                              const DirectionSet& directions,
                              double depth,
                              const Scene& scene,
                              const std::vector<PosedView>& views,
                              const std::vector<BlurredImage>& images) {
  const std::vector<LocalView> seen =
      LocateAll(place, chosen.views, scene, views, images);
  SurfaceEvidence evidence;
  if (seen.size() < kMinViews) return evidence;
  double noise_variance = 0;
  for (const LocalView& view : seen) {
    noise_variance +=
        view.image->noise_variance() / static_cast<double>(seen.size());
  }
  noise_variance = std::max(kLeastVariance, kAddedVariance + noise_variance);
  const double step = chosen.step;
  std::array<StripSet, 2> sides;
  for (std::size_t d = 0; d < kNumDirections; ++d) {
    if (!directions[d]) continue;
    const double angle = static_cast<double>(d) * 2 * kPi / kNumDirections;
    const double cosine = std::cos(angle), sine = std::sin(angle);
    for (StripSet& side : sides) side.Clear();
    for (const LocalView& view : seen) {
      const double facing = std::sin(angle - view.azimuth);
      if (std::abs(facing) < kMinSine) continue;
      const std::size_t side = facing > 0 ? 0 : 1;
      const Vector2d back = depth * AwayFromCameras(angle, side);
      const Vector2d begin =
          view.pixel + back.x() * view.normal + back.y() * view.binormal;
      const Vector2d across =
          step * (cosine * view.normal + sine * view.binormal);
      if (Sample(view, begin, across, step * view.along, sides[side].Next())) {
        sides[side].Keep();
      }
    }
    for (std::size_t side = 0; side < 2; ++side) {
      evidence.log_bayes[side][d] =
          sides[side].LogBayes(other_curves[d] / step, noise_variance);
    }
  }
  return evidence;
}

}  // namespace curvix
