#pragma once

#include <atomic>
#include <cstdint>
#include <exception>
#include <functional>
#include <thread>
#include <vector>

namespace hemoscale::micro {

/// A number that one thread raises and others wait for without spinning: they sleep in the kernel
/// of the operating system, so that waiting takes no time from whoever shares the core.
class Milestone {
 public:
  std::int64_t reached() const { return value_.load(std::memory_order_acquire); }
  void set(std::int64_t value) {
    value_.store(value, std::memory_order_release);
    value_.notify_all();
  }
  void wait_for(std::int64_t wanted) const {
    for (std::int64_t now = reached(); now < wanted; now = reached()) {
      value_.wait(now, std::memory_order_acquire);
    }
  }

 private:
  std::atomic<std::int64_t> value_{0};
};

/// Threads that sleep between tasks. The caller works as member 0.
class ThreadTeam {
 public:
  /// @param size  at least 1
  explicit ThreadTeam(int size);
  ThreadTeam(const ThreadTeam&) = delete;
  ThreadTeam& operator=(const ThreadTeam&) = delete;
  ~ThreadTeam();

  int size() const { return static_cast<int>(threads_.size()) + 1; }

  /// Calls task(member) once on every member and returns when all have finished. The first
  /// exception by number of the member is thrown again here.
  void run(const std::function<void(int)>& task);

 private:
  void work(int member);

  std::vector<std::thread> threads_;
  const std::function<void(int)>* task_ = nullptr;
  std::vector<std::exception_ptr> failures_;
  std::atomic<std::int64_t> started_{0};
  std::atomic<int> working_{0};
  bool ending_ = false;
};

}  // namespace hemoscale::micro
