// SPDX-License-Identifier: BSD-3-Clause
// How long a frame takes to reach the disk: gathered and written by one rank, as this program does, or by all ranks with parallel
// HDF5 (docs/decisions/0040-one-rank-writes.md).
//
//     cmake --build build --target parallel_file && mpiexec -n 2 build/bin/parallel_file FOLDER [MILLIONS_OF_NODES] [ROUNDS]
//
// A frame has a displacement and a stress at each node, nine doubles. Nodes belong to ranks in blocks of a thousand, by turns, as
// the parts of a mesh lie in the order of its nodes. Prints seconds until the frame is on the disk, the median of the rounds.
#include <fmt/format.h>
#include <hdf5.h>
#include <mpi.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <functional>
#include <string>
#include <vector>

namespace {

constexpr hsize_t block = 1000, components = 9;

struct Frame {
  hsize_t nodes = 0;
  int rank = 0, ranks = 1;
  std::vector<double> own{};  // node by node, the blocks of this rank one behind the other

  hsize_t own_blocks() const { return nodes / block / static_cast<hsize_t>(ranks); }
};

hid_t dataset_of(hid_t file, const Frame& frame) {
  const hsize_t shape[] = {frame.nodes, components};
  const hid_t space = H5Screate_simple(2, shape, nullptr);
  const hid_t data = H5Dcreate2(file, "frame", H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  H5Sclose(space);
  return data;
}

/// Blocks arrive rank after rank and are put where they belong.
void write_by_one(const Frame& frame, const std::string& path) {
  const auto size = static_cast<int>(frame.own.size());
  std::vector<double> all(frame.rank == 0 ? frame.own.size() * static_cast<std::size_t>(frame.ranks) : 0), placed(all.size());
  MPI_Gather(frame.own.data(), size, MPI_DOUBLE, all.data(), size, MPI_DOUBLE, 0, MPI_COMM_WORLD);
  if (frame.rank != 0) return;
  constexpr auto length = static_cast<std::ptrdiff_t>(block * components);
  for (hsize_t b = 0; b < frame.own_blocks(); ++b)
    for (int r = 0; r < frame.ranks; ++r) {
      const auto from = static_cast<std::ptrdiff_t>(static_cast<hsize_t>(r) * frame.own_blocks() + b);
      const auto to = static_cast<std::ptrdiff_t>(b * static_cast<hsize_t>(frame.ranks) + static_cast<hsize_t>(r));
      std::copy_n(all.begin() + from * length, length, placed.begin() + to * length);
    }
  const hid_t file = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  const hid_t data = dataset_of(file, frame);
  H5Dwrite(data, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, placed.data());
  H5Dclose(data);
  H5Fclose(file);
}

void write_by_all(const Frame& frame, const std::string& path, H5FD_mpio_xfer_t how) {
  const hid_t access = H5Pcreate(H5P_FILE_ACCESS), transfer = H5Pcreate(H5P_DATASET_XFER);
  H5Pset_fapl_mpio(access, MPI_COMM_WORLD, MPI_INFO_NULL);
  H5Pset_dxpl_mpio(transfer, how);
  const hid_t file = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access);
  const hid_t data = dataset_of(file, frame), space = H5Dget_space(data);
  const hsize_t start[] = {static_cast<hsize_t>(frame.rank) * block, 0};
  const hsize_t stride[] = {static_cast<hsize_t>(frame.ranks) * block, 1};
  const hsize_t count[] = {frame.own_blocks(), 1}, size[] = {block, components};
  H5Sselect_hyperslab(space, H5S_SELECT_SET, start, stride, count, size);
  const hsize_t mine[] = {frame.own_blocks() * block, components};
  const hid_t memory = H5Screate_simple(2, mine, nullptr);
  H5Dwrite(data, H5T_NATIVE_DOUBLE, memory, space, transfer, frame.own.data());
  for (const hid_t s : {memory, space}) H5Sclose(s);
  H5Dclose(data);
  H5Fclose(file);
  for (const hid_t list : {access, transfer}) H5Pclose(list);
}

double median_seconds(const std::function<void()>& write, const std::string& path, int rank, int rounds) {
  std::vector<double> times;
  for (int i = 0; i < rounds; ++i) {
    MPI_Barrier(MPI_COMM_WORLD);
    const double begun = MPI_Wtime();
    write();
    if (rank == 0) sync();
    MPI_Barrier(MPI_COMM_WORLD);
    times.push_back(MPI_Wtime() - begun);
    if (rank == 0) std::remove(path.c_str());
  }
  std::sort(times.begin(), times.end());
  return times[times.size() / 2];
}

}  // namespace

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  Frame frame;
  MPI_Comm_rank(MPI_COMM_WORLD, &frame.rank);
  MPI_Comm_size(MPI_COMM_WORLD, &frame.ranks);
  const std::string path = std::string(argc > 1 ? argv[1] : ".") + "/parallel_file.h5";
  const double millions = argc > 2 ? std::atof(argv[2]) : 1;
  const int rounds = argc > 3 ? std::atoi(argv[3]) : 7;
  const hsize_t turn = block * static_cast<hsize_t>(frame.ranks);
  frame.nodes = static_cast<hsize_t>(millions * 1e6) / turn * turn;
  frame.own.assign(frame.nodes / static_cast<hsize_t>(frame.ranks) * components, 1.0 + frame.rank);
  const auto tell = [&](const char* way, const std::function<void()>& write) {
    const double seconds = median_seconds(write, path, frame.rank, rounds);
    const double megabytes = static_cast<double>(frame.nodes * components * sizeof(double)) / 1e6;
    if (frame.rank == 0) fmt::print("{:<28}{:8.3f} s {:8.0f} MB/s\n", way, seconds, megabytes / seconds);
  };
  tell("gathered, one rank writes", [&] { write_by_one(frame, path); });
  tell("all ranks, collectively", [&] { write_by_all(frame, path, H5FD_MPIO_COLLECTIVE); });
  tell("all ranks, each by itself", [&] { write_by_all(frame, path, H5FD_MPIO_INDEPENDENT); });
  MPI_Finalize();
  return 0;
}
