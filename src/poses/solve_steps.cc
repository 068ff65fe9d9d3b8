// SPDX-License-Identifier: BSD-3-Clause
#include "poses/solve_steps.h"

#include <Eigen/Dense>
#include <algorithm>
#include <optional>
#include <tuple>
#include <utility>

#include "base/check.h"
#include "base/parallel.h"
#include "poses/lower_blocks.h"

namespace curvix {
namespace {

// Least diagonal that damping multiplies: unobserved unknowns stay fixed.
constexpr double kMinDiagonal = 1e-6;

// Share of the trace: radii that are nearly unobservable stay fixed.
constexpr double kRadiusDamping = 1e-9;

using Matrix6d = Eigen::Matrix<double, 6, 6>;
using Matrix8d = Eigen::Matrix<double, 8, 8>;
using Matrix83d = Eigen::Matrix<double, 8, 3>;
using Matrix86d = Eigen::Matrix<double, 8, 6>;

template <typename Matrix>
void Damp(double damping, Matrix& matrix) {
  matrix.diagonal() += damping * matrix.diagonal().cwiseMax(kMinDiagonal);
}

// Sums of matrices by an index, in the order in which indices come first.
template <typename Matrix>
class BlockRow {
 public:
  explicit BlockRow(std::size_t num_indices) : places_(num_indices) {}

  Matrix& operator[](std::size_t index) {
    if (!places_[index]) {
      places_[index] = blocks_.size();
      blocks_.emplace_back(index, Matrix::Zero());
    }
    return blocks_[*places_[index]].second;
  }
  const std::vector<std::pair<std::size_t, Matrix>>& blocks() const {
    return blocks_;
  }

 private:
  std::vector<std::optional<std::size_t>> places_;
  std::vector<std::pair<std::size_t, Matrix>> blocks_;
};

template <typename Matrix>
using Blocks = std::vector<std::pair<std::size_t, Matrix>>;

// The normal equations of one sample.
struct SampleNormal {
  Eigen::Matrix3d inverse;
  Eigen::Vector3d gradient;
  Blocks<Matrix83d> by_camera;  // the cameras that see it, ascending
};

// The normal equations of one view without samples: with the views up to its
// own, and with cameras.
struct ViewNormal {
  Blocks<Matrix6d> with_views;
  Blocks<Matrix86d> with_cameras;
  Vector6d gradient;
};

// Of one camera without samples, with the cameras up to its own.
struct CameraNormal {
  Blocks<Matrix8d> with_cameras;
  Vector8d gradient;
};

class System {
 public:
  System(const EquationOwners& owners,
         const std::vector<StepEquation>& equations,
         const std::vector<StepPrior>& priors,
         const std::vector<LensPrior>& lens_priors,
         double damping,
         int num_threads)
      : owners_(owners),
        equations_(equations),
        priors_(priors),
        lens_priors_(lens_priors),
        damping_(damping),
        num_threads_(num_threads),
        samples_(owners.first_of_sample.size() - 1) {}

  Steps Solve() {
    ParallelFor(samples_.size(), num_threads_, [&](std::size_t i) {
      samples_[i] = NormalOfSample(i);
    });
    samples_of_camera_.resize(lens_priors_.size());
    for (std::size_t i = 0; i < samples_.size(); ++i) {
      for (const auto& [camera_idx, by_lens] : samples_[i].by_camera) {
        samples_of_camera_[camera_idx].push_back(i);
      }
    }
    std::vector<ViewNormal> views(priors_.size());
    ParallelFor(views.size(), num_threads_, [&](std::size_t i) {
      views[i] = NormalOfView(i);
    });
    std::vector<CameraNormal> cameras(lens_priors_.size());
    ParallelFor(cameras.size(), num_threads_, [&](std::size_t i) {
      cameras[i] = NormalOfCamera(i);
    });
    Steps steps = SolveReduced(views, cameras);
    steps.offsets.resize(samples_.size());
    ParallelFor(samples_.size(), num_threads_, [&](std::size_t i) {
      steps.offsets[i] = OffsetOf(i, steps);
    });
    return steps;
  }

 private:
  template <typename F>
  void VisitSample(std::size_t sample_idx, const F& f) const {
    for (std::size_t e = owners_.first_of_sample[sample_idx];
         e < owners_.first_of_sample[sample_idx + 1];
         ++e) {
      f(equations_[e], owners_.of_equation[e].view_idx);
    }
  }

  bool HasLenses() const { return !lens_priors_.empty(); }

  SampleNormal NormalOfSample(std::size_t sample_idx) const {
    SampleNormal normal;
    Eigen::Matrix3d matrix = Eigen::Matrix3d::Zero();
    normal.gradient.setZero();
    VisitSample(sample_idx, [&](const StepEquation& equation, std::size_t i) {
      matrix += equation.by_offset * equation.by_offset.transpose();
      normal.gradient += equation.residual * equation.by_offset;
      if (HasLenses()) AddLens(equation, owners_.camera_of_view[i], &normal);
    });
    matrix(2, 2) += kRadiusDamping * matrix.trace();
    Damp(damping_, matrix);
    normal.inverse = matrix.inverse();
    return normal;
  }

  static void AddLens(const StepEquation& equation,
                      std::size_t camera_idx,
                      SampleNormal* normal) {
    auto& blocks = normal->by_camera;
    auto place = std::find_if(blocks.begin(), blocks.end(), [&](const auto& b) {
      return b.first >= camera_idx;
    });
    if (place == blocks.end() || place->first != camera_idx) {
      place = blocks.insert(place, {camera_idx, Matrix83d::Zero()});
    }
    place->second += equation.by_lens * equation.by_offset.transpose();
  }

  // Of the view's equations alone, as if samples stayed.
  Matrix6d OwnBlock(std::size_t view_idx) const {
    Matrix6d block = priors_[view_idx].factors.cwiseAbs2().asDiagonal();
    for (const std::size_t e : owners_.by_view[view_idx]) {
      block += equations_[e].by_pose * equations_[e].by_pose.transpose();
    }
    Damp(damping_, block);
    return block;
  }

  ViewNormal NormalOfView(std::size_t view_idx) const {
    BlockRow<Matrix6d> views(view_idx + 1);
    BlockRow<Matrix86d> cameras(lens_priors_.size());
    views[view_idx] = OwnBlock(view_idx);
    const StepPrior& prior = priors_[view_idx];
    ViewNormal normal;
    normal.gradient = prior.factors.cwiseProduct(prior.residuals);
    for (const std::size_t e : owners_.by_view[view_idx]) {
      const StepEquation& own = equations_[e];
      const std::size_t sample_idx = owners_.of_equation[e].sample_idx;
      const SampleNormal& sample = samples_[sample_idx];
      const Eigen::Vector3d pull = sample.inverse * own.by_offset;
      normal.gradient +=
          (own.residual - pull.dot(sample.gradient)) * own.by_pose;
      VisitSample(sample_idx, [&](const StepEquation& other, std::size_t i) {
        if (i > view_idx) return;
        const Vector6d pulled = pull.dot(other.by_offset) * own.by_pose;
        views[i].noalias() -= pulled * other.by_pose.transpose();
      });
      if (!HasLenses()) continue;
      cameras[owners_.camera_of_view[view_idx]] +=
          own.by_lens * own.by_pose.transpose();
      for (const auto& [camera_idx, by_lens] : sample.by_camera) {
        cameras[camera_idx] -= (by_lens * pull) * own.by_pose.transpose();
      }
    }
    normal.with_views = views.blocks();
    normal.with_cameras = cameras.blocks();
    return normal;
  }

  // As OwnBlock() and the gradient with it, of a camera.
  std::pair<Matrix8d, Vector8d> OwnOfCamera(std::size_t camera_idx) const {
    const LensPrior& prior = lens_priors_[camera_idx];
    Matrix8d block = prior.factors.cwiseAbs2().asDiagonal();
    Vector8d gradient = prior.factors.cwiseProduct(prior.residuals);
    for (std::size_t i = 0; i < owners_.by_view.size(); ++i) {
      if (owners_.camera_of_view[i] != camera_idx) continue;
      for (const std::size_t e : owners_.by_view[i]) {
        const Vector8d& by_lens = equations_[e].by_lens;
        block += by_lens * by_lens.transpose();
        gradient += equations_[e].residual * by_lens;
      }
    }
    Damp(damping_, block);
    return {block, gradient};
  }

  CameraNormal NormalOfCamera(std::size_t camera_idx) const {
    BlockRow<Matrix8d> cameras(camera_idx + 1);
    CameraNormal normal;
    std::tie(cameras[camera_idx], normal.gradient) = OwnOfCamera(camera_idx);
    for (const std::size_t i : samples_of_camera_[camera_idx]) {
      const SampleNormal& sample = samples_[i];
      const auto own = std::find_if(
          sample.by_camera.begin(), sample.by_camera.end(), [&](const auto& b) {
            return b.first == camera_idx;
          });
      const Matrix83d pull = own->second * sample.inverse;
      normal.gradient -= pull * sample.gradient;
      for (const auto& [other_idx, by_lens] : sample.by_camera) {
        if (other_idx > camera_idx) break;
        cameras[other_idx].noalias() -= pull * by_lens.transpose();
      }
    }
    normal.with_cameras = cameras.blocks();
    return normal;
  }

  // First rows in the reduced equations.
  struct Rows {
    std::vector<int> of_view, of_camera;
    std::vector<int> of_block;  // and the number of rows
  };

  // A camera of a single view shares a block with the view, since the two are
  // strongly correlated.
  Rows ChooseRows() const {
    std::vector<int> num_views(lens_priors_.size(), 0);
    if (HasLenses()) {
      for (const std::size_t k : owners_.camera_of_view) ++num_views[k];
    }
    Rows rows;
    rows.of_camera.resize(lens_priors_.size());
    int row = 0;
    for (std::size_t i = 0; i < priors_.size(); ++i) {
      rows.of_block.push_back(row);
      rows.of_view.push_back(std::exchange(row, row + 6));
      if (!HasLenses()) continue;
      const std::size_t k = owners_.camera_of_view[i];
      if (num_views[k] == 1) rows.of_camera[k] = std::exchange(row, row + 8);
    }
    for (std::size_t k = 0; k < num_views.size(); ++k) {
      if (num_views[k] == 1) continue;
      rows.of_block.push_back(row);
      rows.of_camera[k] = std::exchange(row, row + 8);
    }
    rows.of_block.push_back(row);
    return rows;
  }

  // The steps of views and cameras; all zero if the equations have no solution.
  Steps SolveReduced(const std::vector<ViewNormal>& views,
                     const std::vector<CameraNormal>& cameras) const {
    const Rows rows = ChooseRows();
    Eigen::VectorXd gradient(rows.of_block.back());
    LowerBlocks lower(rows.of_block);
    const auto add = [&](int row, int column, const auto& block) {
      if (row >= column) {
        lower.Add(row, column, block);
      } else {
        lower.Add(column, row, block.transpose());
      }
    };
    for (std::size_t i = 0; i < views.size(); ++i) {
      gradient.segment<6>(rows.of_view[i]) = views[i].gradient;
      for (const auto& [k, block] : views[i].with_views) {
        add(rows.of_view[i], rows.of_view[k], block);
      }
      for (const auto& [k, block] : views[i].with_cameras) {
        add(rows.of_camera[k], rows.of_view[i], block);
      }
    }
    for (std::size_t i = 0; i < cameras.size(); ++i) {
      gradient.segment<8>(rows.of_camera[i]) = cameras[i].gradient;
      for (const auto& [k, block] : cameras[i].with_cameras) {
        add(rows.of_camera[i], rows.of_camera[k], block);
      }
    }
    Steps steps;
    steps.increments.assign(views.size(), Vector6d::Zero());
    steps.lenses.assign(cameras.size(), Vector8d::Zero());
    const Eigen::VectorXd solution = lower.Solve(-gradient);
    if (solution.size() == 0) return steps;
    for (std::size_t i = 0; i < views.size(); ++i) {
      steps.increments[i] = solution.segment<6>(rows.of_view[i]);
    }
    for (std::size_t i = 0; i < cameras.size(); ++i) {
      steps.lenses[i] = solution.segment<8>(rows.of_camera[i]);
    }
    return steps;
  }

  // The step of a sample once those of views and cameras are known.
  Eigen::Vector3d OffsetOf(std::size_t sample_idx, const Steps& steps) const {
    Eigen::Vector3d gradient = samples_[sample_idx].gradient;
    VisitSample(sample_idx, [&](const StepEquation& equation, std::size_t i) {
      double step = equation.by_pose.dot(steps.increments[i]);
      if (HasLenses()) {
        step += equation.by_lens.dot(steps.lenses[owners_.camera_of_view[i]]);
      }
      gradient += step * equation.by_offset;
    });
    return -(samples_[sample_idx].inverse * gradient);
  }

  const EquationOwners& owners_;
  const std::vector<StepEquation>& equations_;
  const std::vector<StepPrior>& priors_;
  const std::vector<LensPrior>& lens_priors_;
  const double damping_;
  const int num_threads_;
  std::vector<SampleNormal> samples_;
  std::vector<std::vector<std::size_t>> samples_of_camera_;  // ascending
};

}  // namespace

EquationOwners::EquationOwners(std::vector<Owner> of_equation_,
                               std::vector<std::size_t> camera_of_view_,
                               std::size_t num_samples)
    : of_equation(std::move(of_equation_)),
      by_view(camera_of_view_.size()),
      first_of_sample(num_samples + 1, 0),
      camera_of_view(std::move(camera_of_view_)) {
  for (std::size_t e = 0; e < of_equation.size(); ++e) {
    by_view[of_equation[e].view_idx].push_back(e);
    ++first_of_sample[of_equation[e].sample_idx + 1];
  }
  for (std::size_t i = 0; i < num_samples; ++i) {
    first_of_sample[i + 1] += first_of_sample[i];
  }
}

Steps SolveSteps(const EquationOwners& owners,
                 const std::vector<StepEquation>& equations,
                 const std::vector<StepPrior>& priors,
                 const std::vector<LensPrior>& lens_priors,
                 double damping,
                 int num_threads) {
  CURVIX_CHECK(damping > 0, "damping is " << damping);
  return System(owners, equations, priors, lens_priors, damping, num_threads)
      .Solve();
}

}  // namespace curvix
