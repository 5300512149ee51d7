#include "base/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <condition_variable>
#include <mutex>
#include <numeric>
#include <string>
#include <vector>

#include "facet/error.h"

namespace facet {
namespace {

// How often ParallelFor hands out each index; checks the pieces on the way.
std::vector<int> Visits(std::size_t count, std::size_t grain) {
  std::vector<int> visits(count, 0);  // each index belongs to one piece alone, so these need no atomics
  std::atomic<int> misplaced{0}, pieces{0};
  ParallelFor(count, grain, [&](std::size_t begin, std::size_t end) {
    ++pieces;
    const bool fine = begin < end && begin % grain == 0 && (end == begin + grain || end == count) && end <= count &&
                      end - begin <= grain;
    if (!fine) ++misplaced;
    for (std::size_t i = begin; i < end && i < count; ++i) ++visits[i];
  });
  EXPECT_EQ(misplaced, 0) << count << " by " << grain;
  EXPECT_EQ(std::size_t(pieces), (count + grain - 1) / grain);
  return visits;
}

TEST(ParallelFor, VisitsEachIndexOnce) {
  for (const int threads : {1, 2, 3, 8}) {
    RunWithThreads(threads, [&] {
      for (const std::size_t count : {0, 1, 2, 3, 7, 8, 9, 63, 64, 65, 1000, 4096, 10007}) {
        for (const std::size_t grain : {1, 2, 3, 7, 64, 1000, 4096, 100000}) {
          ASSERT_EQ(Visits(count, grain), std::vector<int>(count, 1)) << count << " by " << grain;
        }
      }
    });
  }
  EXPECT_EQ(Visits(1000, 7), std::vector<int>(1000, 1)) << "outside of any arena";
}

TEST(ParallelFor, Nests) {
  for (const int threads : {1, 2, 8}) {
    RunWithThreads(threads, [&] {
      constexpr std::size_t kRows = 37, kColumns = 211;
      std::vector<int> visits(kRows * kColumns, 0);
      ParallelFor(kRows, 2, [&](std::size_t row_begin, std::size_t row_end) {
        for (std::size_t row = row_begin; row < row_end; ++row) {
          ParallelFor(kColumns, 10, [&](std::size_t begin, std::size_t end) {
            for (std::size_t column = begin; column < end; ++column) ++visits[row * kColumns + column];
          });
        }
      });
      EXPECT_EQ(visits, std::vector<int>(kRows * kColumns, 1));
    });
  }
}

TEST(ParallelFor, PassesOnAnException) {
  for (const int threads : {1, 2, 8}) {
    for (const std::size_t count : {1, 2, 100}) {
      std::atomic<int> running{0}, started{0};
      bool caught = false;
      try {
        RunWithThreads(threads, [&] {
          ParallelFor(count, 1, [&](std::size_t begin, std::size_t) {
            ++running;
            ++started;
            if (begin == count / 2) {
              --running;
              throw Error(ErrorCode::Unsupported, "piece " + std::to_string(begin), "here");
            }
            std::atomic<int> spin{0};
            while (++spin < 1000) {
            }
            --running;
          });
        });
      } catch (const Error& error) {
        caught = true;
        EXPECT_EQ(running, 0) << "the pieces that had started have ended";
        EXPECT_EQ(error.code(), ErrorCode::Unsupported);
        EXPECT_EQ(error.message(), "piece " + std::to_string(count / 2));
      }
      EXPECT_TRUE(caught);
      EXPECT_GE(started, 1);
    }
  }
  EXPECT_EQ(Visits(100, 1), std::vector<int>(100, 1)) << "nothing is left over";
}

TEST(ParallelFor, PassesOnOneOfSeveralExceptions) {
  RunWithThreads(8, [] {
    for (int trial = 0; trial < 20; ++trial) {
      try {
        ParallelFor(64, 1, [](std::size_t begin, std::size_t) { throw int(begin); });
        ADD_FAILURE() << "did not throw";
      } catch (int piece) {
        EXPECT_GE(piece, 0);
        EXPECT_LT(piece, 64);
      }
    }
  });
}

TEST(ParallelFor, PassesOnExceptionsOfNestedCalls) {
  EXPECT_THROW(RunWithThreads(2,
                              [] {
                                ParallelFor(8, 1, [](std::size_t outer, std::size_t) {
                                  ParallelFor(8, 1, [&](std::size_t inner, std::size_t) {
                                    if (outer == 5 && inner == 3) throw Error(ErrorCode::OutOfMemory, "full");
                                  });
                                });
                              }),
               Error);
}

// As many threads as asked for, also more than the machine has cores, and nobody says a word about it.
TEST(RunWithThreads, GrantsAsManyThreadsAsWanted) {
  testing::internal::CaptureStderr();
  for (const int threads : {1, 2, 3, 8, 2, 1}) {
    RunWithThreads(threads, [&] {
      EXPECT_EQ(CurrentThreadCount(), threads);
      // Each piece waits for all the others: they meet only if each has a thread of its own. Where they do not the test
      // does not end, and is ended by the time limit that every test has: any limit here might meet a busy machine.
      std::mutex mutex;
      std::condition_variable arrival;
      int arrived = 0;
      ParallelFor(std::size_t(threads), 1, [&](std::size_t, std::size_t) {
        std::unique_lock lock(mutex);
        ++arrived;
        arrival.notify_all();
        arrival.wait(lock, [&] { return arrived == threads; });
      });
      EXPECT_EQ(arrived, threads);
    });
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(RunWithThreads, ZeroMeansOnePerCore) {
  int threads = 0;
  RunWithThreads(0, [&] { threads = CurrentThreadCount(); });
  EXPECT_GE(threads, 1);
}

TEST(RunWithThreads, InnerArenasHaveTheirOwnCount) {
  RunWithThreads(4, [] {
    RunWithThreads(2, [] { EXPECT_EQ(CurrentThreadCount(), 2); });
    EXPECT_EQ(CurrentThreadCount(), 4);
  });
}

}  // namespace
}  // namespace facet
