// A mesh that wears a material whose bare part is made from its local PCA. Twin: reference::mesh.
#import mesh
#import unpainted_lpca
