#pragma once
// What can go wrong, by who can mend it. Each kind carries the exit status that a tool returns for it.
// Bad input or a failed system call throws one of these; a broken invariant is an assert; numerical trouble that a
// caller can answer (a shorter step) is a status in a result, not an exception.
#include <stdexcept>
#include <string>

namespace pigment {

class Error : public std::runtime_error {
 public:
  Error(int exit_status, const std::string& message) : std::runtime_error(message), exit_status_(exit_status) {}
  int exit_status() const { return exit_status_; }

 private:
  int exit_status_;
};

// A run that blew up or did not converge.
struct NumericsError : Error {
  explicit NumericsError(const std::string& message) : Error(1, message) {}
};
// Wrong usage, or a scene that asks for what cannot be.
struct InputError : Error {
  explicit InputError(const std::string& message) : Error(2, message) {}
};
// An input file that is missing, truncated, corrupt or of another kind.
struct FileError : Error {
  explicit FileError(const std::string& message) : Error(3, message) {}
};
// An output that cannot be written.
struct OutputError : Error {
  explicit OutputError(const std::string& message) : Error(4, message) {}
};

}  // namespace pigment
