#pragma once

#include <atomic>
#include <condition_variable>
#include <deque>
#include <exception>
#include <functional>
#include <map>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "radiosity/base/ranks.h"

namespace radiosity::test {

/// Where the threads of `on_ranks` leave each other messages.
class MailBoxes {
 public:
  void put(int from, int to, Channel channel, std::span<const std::byte> bytes) {
    const std::lock_guard lock(mutex_);
    boxes_[{to, channel}].push_back({from, {bytes.begin(), bytes.end()}});
    n_bytes_ += bytes.size();
    arrived_.notify_all();
  }
  std::vector<std::byte> wait(int from, int to, Channel channel) {
    std::unique_lock lock(mutex_);
    std::vector<std::byte> bytes;
    arrived_.wait(lock, [&] {
      std::deque<Ranks::Message>& box = boxes_[{to, channel}];
      for (auto message = box.begin(); message != box.end(); ++message) {
        if (message->from != from) continue;
        bytes = std::move(message->bytes);
        box.erase(message);
        return true;
      }
      return false;
    });
    return bytes;
  }
  std::optional<Ranks::Message> poll(int to, Channel channel) {
    const std::lock_guard lock(mutex_);
    std::deque<Ranks::Message>& box = boxes_[{to, channel}];
    if (box.empty()) return std::nullopt;
    Ranks::Message message = std::move(box.front());
    box.pop_front();
    return message;
  }
  std::size_t n_bytes() const { return n_bytes_; }

 private:
  std::mutex mutex_;
  std::condition_variable arrived_;
  std::map<std::pair<int, Channel>, std::deque<Ranks::Message>> boxes_;
  std::size_t n_bytes_ = 0;
};

/// A thread as a rank.
class ThreadRank final : public Ranks {
 public:
  ThreadRank(MailBoxes& boxes, int rank, int size) : boxes_(boxes), rank_(rank), size_(size) {}
  int rank() const override { return rank_; }
  int size() const override { return size_; }
  int n_on_machine() const override { return size_; }
  void send(int to, Channel channel, std::span<const std::byte> bytes) override {
    n_moved_ += bytes.size();
    boxes_.put(rank_, to, channel, bytes);
  }
  std::vector<std::byte> receive(int from, Channel channel) override {
    std::vector<std::byte> bytes = boxes_.wait(from, rank_, channel);
    n_moved_ += bytes.size();
    return bytes;
  }
  std::optional<Message> poll(Channel channel) override {
    std::optional<Message> message = boxes_.poll(rank_, channel);
    if (message) n_moved_ += message->bytes.size();
    return message;
  }
  void broadcast(int from, std::span<std::byte> bytes) override {
    if (from == rank_) {
      for (int to = 0; to < size_; ++to) {
        if (to != rank_) send(to, Channel::values, bytes);
      }
      return;
    }
    const std::vector<std::byte> received = receive(from, Channel::values);
    std::copy(received.begin(), received.end(), bytes.begin());
  }
  std::uint64_t bytes_moved() const override { return n_moved_; }

 private:
  MailBoxes& boxes_;
  int rank_;
  int size_;
  std::atomic<std::uint64_t> n_moved_ = 0;
};

/// Runs `work` on so many threads, each a rank. What the first of them throws is thrown.
inline void on_ranks(int size, const std::function<void(Ranks&)>& work) {
  MailBoxes boxes;
  std::vector<std::exception_ptr> errors(size);
  {
    std::vector<std::jthread> threads;
    for (int rank = 0; rank < size; ++rank) {
      threads.emplace_back([&, rank] {
        ThreadRank own(boxes, rank, size);
        try {
          work(own);
        } catch (...) {
          errors[rank] = std::current_exception();
        }
      });
    }
  }
  for (const std::exception_ptr& error : errors) {
    if (error) std::rethrow_exception(error);
  }
}

}  // namespace radiosity::test
