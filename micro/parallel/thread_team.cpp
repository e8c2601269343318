#include "micro/parallel/thread_team.hpp"

namespace hemoscale::micro {

ThreadTeam::ThreadTeam(int size) : failures_(static_cast<std::size_t>(size)) {
  for (int member = 1; member < size; ++member) {
    threads_.emplace_back([this, member] { work(member); });
  }
}

ThreadTeam::~ThreadTeam() {
  ending_ = true;
  started_.fetch_add(1, std::memory_order_release);
  started_.notify_all();
  for (std::thread& thread : threads_) {
    thread.join();
  }
}

void ThreadTeam::run(const std::function<void(int)>& task) {
  task_ = &task;
  working_.store(static_cast<int>(threads_.size()), std::memory_order_relaxed);
  started_.fetch_add(1, std::memory_order_release);
  started_.notify_all();
  try {
    task(0);
  } catch (...) {
    failures_[0] = std::current_exception();
  }
  for (int left = working_.load(std::memory_order_acquire); left > 0;
       left = working_.load(std::memory_order_acquire)) {
    working_.wait(left, std::memory_order_acquire);
  }
  for (std::exception_ptr& failure : failures_) {
    if (failure) {
      const std::exception_ptr first = failure;
      for (std::exception_ptr& other : failures_) other = nullptr;
      std::rethrow_exception(first);
    }
  }
}

void ThreadTeam::work(int member) {
  std::int64_t seen = 0;
  while (true) {
    started_.wait(seen, std::memory_order_acquire);
    seen = started_.load(std::memory_order_acquire);
    if (ending_) {
      return;
    }
    try {
      (*task_)(member);
    } catch (...) {
      failures_[static_cast<std::size_t>(member)] = std::current_exception();
    }
    working_.fetch_sub(1, std::memory_order_acq_rel);
    working_.notify_all();
  }
}

}  // namespace hemoscale::micro
