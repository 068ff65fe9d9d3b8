// SPDX-License-Identifier: BSD-3-Clause
// Each stage by itself on blocks of growing numbers of views and pixels, one
// thread. A stage is timed only once its result is known to be right.
#include <benchmark/benchmark.h>
#include <curvix/curvix.h>
#include <algorithm>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "curve_drawing/group_edges.h"
#include "curve_drawing/link_edges.h"
#include "curve_refinement/refine_curves.h"
#include "io/stage_io.h"
#include "model/posed_view.h"
#include "plugin/commands/command_synthesize.h"
#include "tests/support/temporary_folder.h"

namespace curvix {
namespace {

Options OneThread() {
  Options options;
  options.runtime.num_threads = 1;
  return options;
}

const Options kOptions = OneThread();

// What all stages need, each made once.
struct Input {
  TemporaryFolder folder;
  SyntheticScene made;
  std::vector<PosedView> views;
  std::vector<EdgeMap> edge_maps;
  EdgeSketch sketch;
  NeighborhoodGraph graph;
  std::vector<Curve> curves;

  std::int64_t NumEdges2d() const {
    std::int64_t sum = 0;
    for (const EdgeMap& map : edge_maps) {
      sum += static_cast<std::int64_t>(map.edges.size());
    }
    return sum;
  }
};

template <typename T>
T Value(Result<T> result) {
  if (!result.ok()) throw std::runtime_error(result.status().message());
  return std::move(result).value();
}

void Require(bool condition, const std::string& what) {
  if (!condition) throw std::runtime_error("wrong result: " + what);
}

// The share of every tenth true sample with a 3D edge within 0.5 % of the
// block.
double Completeness(const Input& input) {
  std::size_t num_found = 0, num_asked = 0;
  for (std::size_t i = 0; i < input.made.truth.size(); i += 10) {
    const Eigen::Vector3d& place = input.made.truth[i].position;
    ++num_asked;
    num_found += std::any_of(
        input.sketch.edges.begin(), input.sketch.edges.end(), [&](auto& edge) {
          return (edge.position - place).norm() < 0.005;
        });
  }
  return static_cast<double>(num_found) / static_cast<double>(num_asked);
}

std::unique_ptr<Input> MakeInput(int num_views, int size_px) {
  auto input = std::make_unique<Input>();
  SyntheticOptions options;
  options.solid = SyntheticSolid::kBlock;
  options.num_views = num_views;
  options.width = options.height = size_px;
  const Status status = Synthesize(options, input->folder.path() / "block");
  Require(status.ok(), status.message());
  input->made = Value(MakeSyntheticScene(options));
  Scene& scene = input->made.scene;
  for (View& view : scene.views) {
    view.image_path = input->folder.path() / "block/images" / view.name;
  }
  input->views = MakePosedViews(scene);
  input->edge_maps = Value(DetectEdges(scene, kOptions));
  input->sketch = Value(SketchEdges(scene, input->edge_maps, kOptions));
  Require(Completeness(*input) > 0.8, "edges of the block are missing");
  input->graph = LinkEdges(input->sketch.edges,
                           input->edge_maps,
                           input->views,
                           kOptions.neighborhood,
                           1);
  input->curves = GroupEdges(input->sketch.edges,
                             input->graph,
                             input->views,
                             kOptions.connectivity,
                             1);
  double length = 0;
  for (const Curve& curve : RefineCurves(input->curves,
                                         {input->views,
                                          input->edge_maps,
                                          input->sketch.edge_sigma_px,
                                          kOptions.curve_refinement,
                                          1})) {
    length += Length(curve);
  }
  const double truth = static_cast<double>(input->made.truth.size()) / 500;
  Require(length > 0.7 * truth && length < 1.3 * truth, "length of the curves");
  return input;
}

const Input& InputOf(benchmark::State& state) {
  static std::map<std::pair<int, int>, std::unique_ptr<Input>> inputs;
  const std::pair key(static_cast<int>(state.range(0)),
                      static_cast<int>(state.range(1)));
  std::unique_ptr<Input>& input = inputs[key];
  if (input == nullptr) input = MakeInput(key.first, key.second);
  state.counters["edges2d"] = static_cast<double>(input->NumEdges2d());
  state.counters["edges3d"] = static_cast<double>(input->sketch.edges.size());
  return *input;
}

// Runs `stage` on the input of `state` until its time is known.
template <typename F>
void Time(benchmark::State& state, const F& stage) {
  const Input& input = InputOf(state);
  for (auto _ : state) benchmark::DoNotOptimize(stage(input));
}

void Detect(benchmark::State& state) {
  Time(state, [](const Input& input) {
    return DetectEdges(input.made.scene, kOptions);
  });
}

void Sketch(benchmark::State& state) {
  Time(state, [](const Input& input) {
    return SketchEdges(input.made.scene, input.edge_maps, kOptions);
  });
  state.counters["hypotheses"] =
      static_cast<double>(InputOf(state).sketch.counts.hypotheses);
}

void Link(benchmark::State& state) {
  Time(state, [](const Input& input) {
    return LinkEdges(input.sketch.edges,
                     input.edge_maps,
                     input.views,
                     kOptions.neighborhood,
                     1);
  });
  state.counters["links"] =
      static_cast<double>(InputOf(state).graph.NumLinks());
}

void Connect(benchmark::State& state) {
  Time(state, [](const Input& input) {
    return GroupEdges(
        input.sketch.edges, input.graph, input.views, kOptions.connectivity, 1);
  });
}

void Refine(benchmark::State& state) {
  Time(state, [](const Input& input) {
    return RefineCurves(input.curves,
                        {input.views,
                         input.edge_maps,
                         input.sketch.edge_sigma_px,
                         kOptions.curve_refinement,
                         1});
  });
}

void SaveAndLoadStages(benchmark::State& state) {
  const Input& input = InputOf(state);
  const auto edges = input.folder.path() / "edges.bin";
  const auto sketch = input.folder.path() / "sketch.bin";
  for ([[maybe_unused]] auto _ : state) {
    Require(WriteStageResult(edges, 1, input.edge_maps).ok(), "writing edges");
    Require(WriteStageResult(sketch, 1, input.sketch).ok(), "writing sketch");
    Require(Value(ReadStageResult<std::vector<EdgeMap>>(edges, 1)).size() ==
                input.edge_maps.size(),
            "edges read");
    Require(Value(ReadStageResult<EdgeSketch>(sketch, 1)).edges.size() ==
                input.sketch.edges.size(),
            "sketch read");
  }
}

void Sizes(benchmark::internal::Benchmark* stage) {
  stage->ArgNames({"views", "px"});
  stage->Args({12, 240})->Args({24, 240})->Args({48, 240})->Args({24, 480});
  stage->Unit(benchmark::kMillisecond);
}

BENCHMARK(Detect)->Apply(Sizes);
BENCHMARK(Sketch)->Apply(Sizes);
BENCHMARK(Link)->Apply(Sizes);
BENCHMARK(Connect)->Apply(Sizes);
BENCHMARK(Refine)->Apply(Sizes);
BENCHMARK(SaveAndLoadStages)->Apply(Sizes);

}  // namespace
}  // namespace curvix
