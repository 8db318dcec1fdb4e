// A mesh that wears a material whose bare part is made from its reflectance. Twin: reference::mesh.
#import mesh
#import unpainted_svbrdf
