// SPDX-License-Identifier: BSD-3-Clause
// How this library reports that the outside world is at fault: a code and a
// sentence that says what, where, and what to do. Broken preconditions throw
// std::logic_error instead, and "there is no answer" is an empty optional.
#pragma once

#include <stdexcept>
#include <string>
#include <utility>
#include <variant>

namespace curvix {

enum class StatusCode {
  kOk,
  kInvalidArgument,  // an option or an argument that cannot work
  kNotFound,         // a file, folder or program that cannot be opened
  kDataLoss,         // a file that is broken, truncated or cannot be written
  kUnsupported,      // valid input that this program does not handle
  kExternalTool,     // a child process failed
  kCancelled,        // the user asked to stop
  kInternal,         // our own mistake
};

class [[nodiscard]] Status {
 public:
  Status() = default;  // success
  Status(StatusCode code, std::string message)
      : code_(code), message_(std::move(message)) {}
  static Status InvalidArgument(std::string message) {
    return {StatusCode::kInvalidArgument, std::move(message)};
  }
  static Status NotFound(std::string message) {
    return {StatusCode::kNotFound, std::move(message)};
  }
  static Status DataLoss(std::string message) {
    return {StatusCode::kDataLoss, std::move(message)};
  }
  static Status Unsupported(std::string message) {
    return {StatusCode::kUnsupported, std::move(message)};
  }
  static Status ExternalTool(std::string message) {
    return {StatusCode::kExternalTool, std::move(message)};
  }
  static Status Internal(std::string message) {
    return {StatusCode::kInternal, std::move(message)};
  }

  bool ok() const { return code_ == StatusCode::kOk; }
  StatusCode code() const { return code_; }
  const std::string& message() const { return message_; }

 private:
  StatusCode code_ = StatusCode::kOk;
  std::string message_;
};

// Either a value or the Status that explains why there is none. Reading the
// value of a failure throws std::logic_error.
template <typename T>
class [[nodiscard]] Result {
 public:
  Result(T value) : content_(std::move(value)) {}         // NOLINT: implicit
  Result(Status status) : content_(std::move(status)) {}  // NOLINT: implicit

  bool ok() const { return std::holds_alternative<T>(content_); }
  Status status() const { return ok() ? Status() : std::get<Status>(content_); }

  T& value() & { return Checked(); }
  T&& value() && { return std::move(Checked()); }
  const T& value() const& { return const_cast<Result*>(this)->Checked(); }
  T& operator*() & { return Checked(); }
  T&& operator*() && { return std::move(Checked()); }
  const T& operator*() const& { return value(); }
  T* operator->() { return &Checked(); }
  const T* operator->() const { return &value(); }

 private:
  T& Checked() {
    if (!ok()) throw std::logic_error("no value: " + status().message());
    return std::get<T>(content_);
  }
  std::variant<Status, T> content_;
};

}  // namespace curvix

// In a function that returns a Status or a Result: returns the Status that is
// given if it is a failure.
#define CURVIX_RETURN_IF_ERROR(...)                 \
  do {                                              \
    ::curvix::Status curvix_status = (__VA_ARGS__); \
    if (!curvix_status.ok()) return curvix_status;  \
  } while (false)

// The same of a Result, whose value `target` gets, which may be declared here:
// CURVIX_ASSIGN_OR_RETURN(const Scene scene, ReadColmapScene("proj"));
// Several statements: within an if, it needs braces.
#define CURVIX_ASSIGN_OR_RETURN(target, ...) \
  CURVIX_ASSIGN_OR_RETURN_IN(__LINE__, target, __VA_ARGS__)
#define CURVIX_ASSIGN_OR_RETURN_IN(line, target, ...) \
  CURVIX_ASSIGN_OR_RETURN_AT(line, target, __VA_ARGS__)
#define CURVIX_ASSIGN_OR_RETURN_AT(line, target, ...) \
  CURVIX_ASSIGN_OR_RETURN_BY(curvix_result_##line, target, __VA_ARGS__)
#define CURVIX_ASSIGN_OR_RETURN_BY(result, target, ...) \
  auto result = (__VA_ARGS__);                          \
  if (!result.ok()) return result.status();             \
  target = *std::move(result)
