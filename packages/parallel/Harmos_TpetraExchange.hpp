// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_TPETRA_EXCHANGE_HPP
#define HARMOS_TPETRA_EXCHANGE_HPP

#include <Harmos_Exchange.hpp>

#include <Teuchos_Comm.hpp>
#include <Teuchos_RCP.hpp>

#include <memory>

namespace Harmos
{

/// How ranks talk, by Tpetra: an Import from the owned cells to owned and halo cells for each depth that is asked for.
///
/// Rows of any length travel through the Import's Distributor, with a count for each cell. The lists of cells are kept
/// between calls. All methods but rank and size are collective, and a row's width is the same on all ranks. With one
/// rank nothing is sent.
class TpetraExchange : public Exchange
{
public:
  /// \param comm  The ranks that share the mesh. \param mesh  This rank's local mesh.
  TpetraExchange(Teuchos::RCP<Teuchos::Comm<int> const> const &comm, Mesh const &mesh);
  ~TpetraExchange() override;
  TpetraExchange(TpetraExchange const &) = delete;
  TpetraExchange &operator=(TpetraExchange const &) = delete;

  int rank() const override;
  int size() const override;

  double min(double value) const override;
  double max(double value) const override;
  void sum(double *values, int count) const override;
  void sum(long long *values, int count) const override;
  std::vector<char> gather(std::vector<char> const &mine) const override;

  /// \throw std::runtime_error when depth exceeds the mesh's halo, or where a list has another number of entries.
  HaloCells haloCells(int depth) const override;
  void exchangeCounts(View<int *> const &sent, View<int *> const &received, int depth) const override;
  void exchangePacked(PackedRows const &sent, PackedRows const &received, int depth) const override;

private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

} // namespace Harmos

#endif
