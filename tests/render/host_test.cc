// Inside a program that is not facet's: with threads, arenas and callbacks of its own.
#include <gtest/gtest.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include <atomic>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "facet/error.h"
#include "facet/film.h"
#include "facet/load.h"
#include "facet/render.h"
#include "render/hand_built.h"

namespace facet {
namespace {

LoadedScene Showcase() { return LoadGltf(std::string(FACET_SOURCE_DIR) + "/assets/scenes/showcase.glb"); }

RenderSettings Small(int threads = 0) {
  RenderSettings settings;
  settings.width = 96;
  settings.height = 64;
  settings.threads = threads;
  return settings;
}

// TBB would say on standard error that it cannot give so many threads; and each call has another number.
TEST(Host, RenderersWithOtherNumbersOfThreadsRunAtOnceAndSayNothing) {
  const LoadedScene loaded = Showcase();
  const Digest expected = HashFilm(Render(loaded.scene, Small(1)));
  std::atomic<int> wrong = 0;
  testing::internal::CaptureStderr();
  std::vector<std::thread> threads;
  for (const int count : {1, 2, 3, 8, 16, 64, 0, 5}) {
    threads.emplace_back([&, count] {
      Renderer renderer(loaded.scene);
      Film film;
      for (int i = 0; i < 3; ++i) {
        renderer.Render(Small(count + i), film);
        wrong += HashFilm(film) != expected;
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  std::fflush(stderr);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(wrong, 0);
}

TEST(Host, RendersInsideAnArenaAndALoopOfTheHosts) {
  const LoadedScene loaded = Showcase();
  const Digest expected = HashFilm(Render(loaded.scene, Small()));
  for (const int width : {1, 2, 4}) {
    tbb::task_arena arena(width);
    std::atomic<int> wrong = 0;
    arena.execute([&] {
      tbb::parallel_for(0, 6, [&](int i) { wrong += HashFilm(Render(loaded.scene, Small(i % 3))) != expected; });
    });
    EXPECT_EQ(wrong, 0);
  }
}

// A thread that waits inside facet must not begin a task of the host's, which may want a lock that the thread holds.
TEST(Host, NoTaskOfTheHostsRunsInsideACall) {
  const LoadedScene loaded = Showcase();
  Film film{512, 512, std::vector<glm::vec4>(512 * 512, glm::vec4(0.5f))};
  thread_local bool inside = false;
  std::atomic<int> intrusions = 0;
  tbb::task_arena arena(2);
  arena.execute([&] {
    tbb::task_group group;
    for (int round = 0; round < 20; ++round) {
      for (int i = 0; i < 50; ++i) group.run([&] { intrusions += inside; });
      inside = true;
      EncodeFilm(film, {});
      Render(loaded.scene, Small(2));
      inside = false;
    }
    group.wait();
  });
  EXPECT_EQ(intrusions, 0);
}

TEST(Host, AProgressCallbackThatThrowsEndsTheFrameAndNoMore) {
  const LoadedScene loaded = Showcase();
  Renderer renderer(loaded.scene);
  RenderSettings settings = Small();
  settings.width = settings.height = 512;
  Film film;
  renderer.Render(settings, film);
  const Digest expected = HashFilm(film);
  for (const int threads : {1, 2, 8}) {
    settings.threads = threads;
    settings.progress = [](double share) {
      if (share > 0.3) throw std::runtime_error("enough");
    };
    std::string what;
    try {
      renderer.Render(settings, film);
    } catch (const std::runtime_error& error) {
      what = error.what();
    }
    EXPECT_EQ(what, "enough");
    settings.progress = nullptr;
    renderer.Render(settings, film);
    EXPECT_EQ(HashFilm(film), expected);
  }
}

TEST(Host, ThreadsHaveABound) {
  const Scene scene;
  for (const int threads : {-1, 1025, 1 << 30}) {
    try {
      Render(scene, Small(threads));
      ADD_FAILURE() << threads;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::InvalidUsage);
      EXPECT_NE(std::string(error.what()).find("0 (one per core) to 1024 are accepted"), std::string::npos)
          << error.what();
    }
  }
  Render(scene, Small(1024));
}

}  // namespace
}  // namespace facet
